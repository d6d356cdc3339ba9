// SPDX-License-Identifier: BSD-3-Clause
#include "slam/loop_closing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "walled_world.hpp"

namespace cca {
namespace {

/// Frames of a drive; `drift` is what the graph adds to each pose for each frame, `spread` the
/// deviation of each edge, in m and rad / 10.
KeyFrames framesOf(test::WalledWorld world, const std::vector<Pose2>& truth, double drift,
                   double spread) {
  KeyFrames frames;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    frames.surfaces.push_back(scanSurface(world.scan(truth[k], 361, 2.0 * M_PI, 0.01, 12.0)));
    Pose2 pose = truth[k];
    pose.x += drift * static_cast<double>(k);
    const int frame = frames.graph.add(pose);
    if (k == 0) continue;
    const Eigen::Vector3d information(1.0, 1.0, 100.0);
    frames.graph.connect({frame - 1, frame, frames.graph.pose(frame - 1).inverse() * pose,
                          (information / (spread * spread)).asDiagonal(), EdgeKind::kWheels});
  }
  return frames;
}

/// Along one side of the hall, and back.
std::vector<Pose2> thereAndBack() {
  std::vector<Pose2> way;
  for (int k = 0; k < 24; ++k) way.push_back({0.5 * k, 0.0, 0.0});
  for (int k = 24; k-- > 0;) way.push_back({0.5 * k, 0.3, M_PI});
  return way;
}

TEST(LoopClosing, AnEarlierVisitIsACandidateAndWhatIsTiedIsNot) {
  const auto truth = thereAndBack();
  const KeyFrames frames = framesOf(test::hallWithBlocks(), truth, 0.01, 0.1);
  const int last = frames.size() - 1;
  const auto candidates = loopCandidates(frames, last);
  ASSERT_FALSE(candidates.empty());
  EXPECT_LT(candidates.front().node, 4) << "where the drive began";
  for (const auto& candidate : candidates) EXPECT_GT(candidate.position, kTiedSigma);
  const KeyFrames sure = framesOf(test::hallWithBlocks(), truth, 0.0, 1e-4);
  EXPECT_TRUE(loopCandidates(sure, last).empty());
}

TEST(LoopClosing, ASearchAtAVisitUndoesTheDrift) {
  const auto truth = thereAndBack();
  const KeyFrames frames = framesOf(test::hallWithBlocks(), truth, 0.015, 0.1);
  const int last = frames.size() - 1;
  const auto candidates = loopCandidates(frames, last);
  ASSERT_FALSE(candidates.empty());
  PlaceSearch search = PlaceSearch::atVisit(frames, last, candidates.front());
  search.run();
  const auto verdict = search.verdict(frames);
  ASSERT_TRUE(verdict.has_value());
  const auto there = static_cast<std::size_t>(verdict->candidate);
  const Pose2 right = truth[there].inverse() * truth[static_cast<std::size_t>(last)];
  EXPECT_LT((verdict->T_candidate_frame.position() - right.position()).norm(), 0.05);
  EXPECT_GT(verdict->moved, 0.5) << "the graph had it elsewhere";
  EXPECT_GT(verdict->agreement, 0.95);
  EXPECT_FALSE(search.rival(frames).has_value()) << "asked of searches anywhere alone";
}

/// Two equal rooms, 20 m apart, that are mapped; and a scan of another part in the second one.
TEST(LoopClosing, ASearchAnywhereTellsTheRivalOfAPlace) {
  test::WalledWorld world;
  std::vector<Pose2> mapped;
  for (const double x : {0.0, 20.0}) {
    world.addBox(x, 0.0, x + 6.0, 4.0);
    world.addBox(x + 1.0, 3.0, x + 2.0, 3.4);
    world.addWall({x + 3.5, 4.0}, {x + 6.0, 1.5});
    for (int k = 0; k < 6; ++k) mapped.push_back({x + 1.0 + 0.7 * k, 2.0, 0.0});
  }
  KeyFrames frames = framesOf(world, mapped, 0.0, 0.01);
  const Pose2 truth{23.1, 1.7, 0.4};
  frames.surfaces.push_back(scanSurface(world.scan(truth, 361, 2.0 * M_PI, 0.01, 12.0)));
  const int frame = frames.graph.add({-7.0, 50.0, 2.0});
  PlaceSearch search = PlaceSearch::anywhere(frames, frame, 0);
  while (!search.advance(20000)) continue;
  const auto verdict = search.verdict(frames), rival = search.rival(frames);
  ASSERT_TRUE(verdict && rival);
  EXPECT_TRUE(verdict->has_rival);
  double nearest = HUGE_VAL, farthest = 0.0;
  for (const auto& found : {*verdict, *rival}) {
    const Pose2 there = frames.graph.pose(found.candidate) * found.T_candidate_frame;
    const double off = (there.position() - truth.position()).norm();
    nearest = std::min(nearest, off);
    farthest = std::max(farthest, off);
    EXPECT_NEAR(there.theta, truth.theta, 0.02);
  }
  EXPECT_LT(nearest, 0.03);
  EXPECT_NEAR(farthest, 20.0, 0.1);
}

}  // namespace
}  // namespace cca
