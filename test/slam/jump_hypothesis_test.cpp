// SPDX-License-Identifier: BSD-3-Clause
#include "slam/jump_hypothesis.hpp"

#include <gtest/gtest.h>

#include "walled_world.hpp"

namespace cca {
namespace {

/// A robot in a lopsided room, mapped by one key frame at its start.
class Jump : public testing::Test {
 protected:
  Jump() : tracker_(matchSurface) {
    world_.addBox(0.0, 0.0, 8.0, 5.0);
    world_.addWall({5.0, 0.0}, {5.0, 1.5});
    world_.addWall({2.0, 5.0}, {2.0, 4.2});
    frames_.surfaces.push_back(seenFrom(start_));
    frames_.graph.add(start_);
    tracker_.lookAt(0);
  }

  ScanSurface seenFrom(const Pose2& pose) {
    return scanSurface(world_.scan(pose, 361, 2.0 * M_PI, 0.005));
  }

  /// One scan at `truth`, while the odometry tells a step of 0.2 m ahead from `believed`.
  std::optional<LocalMatch> scanAt(const Pose2& truth, const Pose2& believed) {
    JumpHypothesis::Tracked tracked;
    tracked.T_map_frame = start_;
    tracked.motion.T_before_after = {0.2, 0.0, 0.0};
    tracked.prior.mean = believed;
    tracked.prior.information = Eigen::Vector3d(1e4, 1e4, 1e4).asDiagonal();
    const ScanSurface surface = seenFrom(truth);
    tracked.here = tracker_.matchLocally(frames_, surface, tracked.prior, believed, 0.05);
    return jump_.update(frames_, tracker_, monitor_, surface, tracked);
  }

  test::WalledWorld world_;
  Pose2 start_{3.0, 2.5, 0.0};
  KeyFrames frames_;
  ScanTracker tracker_;
  ContradictionMonitor monitor_;
  JumpHypothesis jump_;
};

TEST_F(Jump, IsNotSuggestedByAScanThatAgrees) {
  EXPECT_FALSE(scanAt({3.2, 2.5, 0.0}, {3.2, 2.5, 0.0}));
  EXPECT_FALSE(jump_.isOpen());
}

TEST_F(Jump, IsAcceptedOnceScansAgreeThereOverEnoughWay) {
  // Turned by 60 degrees at one place, which the odometry has not seen.
  const double turn = M_PI / 3.0;
  std::optional<LocalMatch> there;
  int scans = 0;
  double way = 0.0;
  for (; scans < 20 && !there; ++scans, way += 0.2) {
    const Pose2 truth = Pose2{3.0, 2.5, turn} * Pose2{way, 0.0, 0.0};
    there = scanAt(truth, {3.0 + way, 2.5, 0.0});
    EXPECT_TRUE(jump_.isOpen()) << scans;
    if (there) {
      EXPECT_NEAR(there->match.T_map_query.theta, turn, 0.02);
      EXPECT_NEAR(there->match.T_map_query.x, truth.x, 0.03);
    }
  }
  ASSERT_TRUE(there);
  EXPECT_GE(scans, 4) << "less than half a metre of way";
  EXPECT_EQ(jump_.poses().size(), static_cast<std::size_t>(scans));
}

TEST_F(Jump, IsGivenUpWhenTheNextScanAgreesHere) {
  EXPECT_FALSE(scanAt({3.0, 2.5, M_PI / 3.0}, {3.0, 2.5, 0.0}));
  EXPECT_TRUE(jump_.isOpen());
  EXPECT_FALSE(scanAt({3.2, 2.5, 0.0}, {3.2, 2.5, 0.0}));
  EXPECT_FALSE(jump_.isOpen());
}

/// The same robot in the middle of four equal posts: a quarter of a turn shows it the same.
class JumpAmongPosts : public Jump {
 protected:
  JumpAmongPosts() {
    world_ = {};
    for (const double x : {0.0, 6.0})
      for (const double y : {-0.5, 5.5}) world_.addBox(x - 0.25, y - 0.25, x + 0.25, y + 0.25);
    frames_ = {};
    frames_.surfaces.push_back(seenFrom(start_));
    frames_.graph.add(start_);
    tracker_.lookAt(0);
  }
};

TEST_F(JumpAmongPosts, IsNotAQuarterOfATurnWhereLessExplainsTheScan) {
  for (const double turn : {0.2, 0.4, -0.5}) {
    jump_.reset();
    EXPECT_FALSE(scanAt({3.0, 2.5, turn}, {3.0, 2.5, 0.0}));
    ASSERT_TRUE(jump_.isOpen()) << turn;
    EXPECT_NEAR(jump_.poses().back().theta, turn, 0.05);
  }
}

}  // namespace
}  // namespace cca
