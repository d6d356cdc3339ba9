// SPDX-License-Identifier: BSD-3-Clause
#include "slam/loop_review.hpp"

#include <gtest/gtest.h>

#include "two_laps.hpp"

namespace cca {
namespace {

/// That the second lap has been seen where `off` [m, along the first one's way] from its place.
LoopVerdict loopAt(const test::TwoLaps& laps, int frame, double off) {
  LoopVerdict loop;
  loop.candidate = frame;
  loop.frame = frame + laps.lap;
  loop.T_candidate_frame = {off, 0.0, 0.0};
  loop.information = Eigen::Vector3d(1e4, 1e4, 1e6).asDiagonal();
  loop.agreement = 0.97;
  loop.common = 0.5;
  loop.window = 4.0;
  return loop;
}

void connect(KeyFrames& frames, const std::vector<LoopVerdict>& loops) {
  for (const LoopVerdict& loop : loops) {
    frames.graph.connect(
        {loop.candidate, loop.frame, loop.T_candidate_frame, loop.information, EdgeKind::kLoop});
  }
  frames.graph.settle(true);
}

TEST(LoopReview, NothingIsTriedWhereVisitsAgree) {
  test::TwoLaps laps;
  const std::vector<LoopVerdict> loops{loopAt(laps, 5, 0.0), loopAt(laps, 8, 0.0)};
  connect(laps.frames, loops);
  const Pose2 before = laps.frames.graph.pose(70);
  const LoopReview review = reviewLoops(laps.frames, loops, loops, 0, doInTurn);
  EXPECT_EQ(review.hypotheses, 0);
  EXPECT_FALSE(review.has_changed);
  EXPECT_EQ(review.loops.size(), 2u);
  EXPECT_FALSE(review.runner_up.has_value());
  EXPECT_EQ(laps.frames.graph.pose(70).x, before.x);
}

// As of racks: both loops agree with each other, and are three metres off.
TEST(LoopReview, ALoopToTheNextPlaceGoesAndTheRefusedOneStands) {
  test::TwoLaps laps;
  const std::vector<LoopVerdict> wrong{loopAt(laps, 10, 3.0), loopAt(laps, 13, 3.0)};
  const std::vector<LoopVerdict> right{loopAt(laps, 40, 0.0), loopAt(laps, 43, 0.0)};
  connect(laps.frames, wrong);
  ASSERT_GT(laps.worstTear(), 2.0);
  std::vector<LoopVerdict> verdicts = wrong;
  verdicts.insert(verdicts.end(), right.begin(), right.end());
  const LoopReview review = reviewLoops(laps.frames, wrong, verdicts, 0, doInTurn);
  EXPECT_TRUE(review.has_changed);
  EXPECT_GT(review.hypotheses, 0);
  EXPECT_LT(laps.worstTear(), 0.1);
  EXPECT_TRUE(review.agreement.isGood());
  for (const LoopVerdict& loop : review.loops) {
    const Pose2 seen = laps.truth[static_cast<std::size_t>(loop.candidate)].inverse() *
                       laps.truth[static_cast<std::size_t>(loop.frame)];
    EXPECT_LT((loop.T_candidate_frame.position() - seen.position()).norm(), 0.2)
        << loop.candidate << ' ' << loop.frame;
  }
  ASSERT_TRUE(review.runner_up.has_value());
  EXPECT_GT(review.runner_up->distance, 0.5);
}

TEST(LoopReview, ALoopThatNobodyFoundIsLookedForWhereVisitsContradict) {
  test::TwoLaps laps;
  laps.moveSecond({0.9, 0.0});
  const LoopReview review = reviewLoops(laps.frames, {}, {}, 0, doInTurn);
  EXPECT_TRUE(review.has_changed);
  EXPECT_FALSE(review.loops.empty());
  EXPECT_LT(laps.worstTear(), 0.1);
  EXPECT_TRUE(review.agreement.isGood());
}

TEST(LoopReview, WhatTiesFramesOfEarlierDrivesStays) {
  test::TwoLaps laps;
  const std::vector<LoopVerdict> old{loopAt(laps, 20, 0.0)};
  connect(laps.frames, old);
  laps.moveSecond({0.9, 0.0});
  const int remembered = laps.frames.size();
  reviewLoops(laps.frames, {}, {}, remembered, doInTurn);
  bool stays = false;
  for (const GraphEdge& edge : laps.frames.graph.edges()) {
    stays = stays || (edge.from == 20 && edge.to == 20 + laps.lap && edge.kind == EdgeKind::kLoop &&
                      edge.T_from_to.x == 0.0);
  }
  EXPECT_TRUE(stays);
}

}  // namespace
}  // namespace cca
