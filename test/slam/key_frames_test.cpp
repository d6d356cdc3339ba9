// SPDX-License-Identifier: BSD-3-Clause
#include "slam/key_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "walled_world.hpp"

namespace cca {
namespace {

const Eigen::Matrix3d kWellKnown = 1e4 * Eigen::Matrix3d::Identity();

/// A drive on the spot and along one side of a hall: a frame every half metre.
class Hall : public testing::Test {
 protected:
  Hall() {
    for (int k = 0; k < 12; ++k) add({0.5 * k, 0.3, 0.1 * k}, {0.5 * k, 0.3, 0.1 * k});
  }
  void add(const Pose2& truth, const Pose2& pose) {
    frames_.surfaces.push_back(scanSurface(world_.scan(truth, 361, 2.0 * M_PI, 0.01)));
    const int k = frames_.graph.add(pose);
    truth_.push_back(truth);
    if (k == 0) return;
    const Pose2 step = truth_[static_cast<std::size_t>(k - 1)].inverse() * truth;
    frames_.graph.connect({k - 1, k, step, kWellKnown, EdgeKind::kWheels});
  }
  double worstError() const {
    double worst = 0.0;
    for (int k = 0; k < frames_.size(); ++k) {
      const Eigen::Vector3d off =
          difference(frames_.graph.pose(k), truth_[static_cast<std::size_t>(k)]);
      worst = std::max(worst, off.norm());
    }
    return worst;
  }
  test::WalledWorld world_ = test::hallWithBlocks();
  KeyFrames frames_;
  std::vector<Pose2> truth_;
};

TEST_F(Hall, AnEdgeSaysWhereTheSecondFrameIsThoughThePosesErr) {
  Pose2 off = truth_[5];
  off.x += 0.03;
  off.y -= 0.02;
  off.theta += 0.01;
  frames_.graph.place(5, off);
  const auto edge = matchEdge(frames_, 4, 5, {0.3, 0.08});
  ASSERT_TRUE(edge.has_value());
  const Eigen::Vector3d error = difference(edge->T_from_to, truth_[4].inverse() * truth_[5]);
  EXPECT_LT(error.head<2>().norm(), 5e-3);
  EXPECT_LT(std::abs(error.z()), 2e-3);
}

TEST_F(Hall, FramesThatSeeNothingOfEachOtherHaveNoEdge) {
  frames_.graph.place(5, {500.0, 0.0, 0.0});
  EXPECT_FALSE(matchEdge(frames_, 4, 5, {0.3, 0.08}).has_value());
}

TEST_F(Hall, AlongABareCorridorAnEdgeSaysNothing) {
  test::WalledWorld corridor;
  corridor.addWall({-100.0, -1.0}, {100.0, -1.0});
  corridor.addWall({-100.0, 1.0}, {100.0, 1.0});
  KeyFrames frames;
  for (const double x : {0.0, 0.5}) {
    frames.surfaces.push_back(scanSurface(corridor.scan({x, 0.0, 0.0}, 361, M_PI)));
    frames.graph.add({x, 0.0, 0.0});
  }
  const auto edge = matchEdge(frames, 0, 1, {0.3, 0.08});
  ASSERT_TRUE(edge.has_value());
  EXPECT_EQ(edge->information(0, 0), 0.0);
  EXPECT_GT(edge->information(1, 1), 100.0);
}

TEST_F(Hall, TheViewHoldsTheNearestTiedFramesAndNoneOfAnotherPart) {
  frames_.surfaces.push_back(frames_.surfaces[3]);
  const int apart = frames_.graph.add(truth_[3]);
  const std::vector<int> view = framesInView(frames_, 3, truth_[3], 5);
  ASSERT_EQ(view.size(), 5u);
  EXPECT_EQ(view.front(), 3);
  EXPECT_EQ(std::count(view.begin(), view.end(), apart), 0);
  for (const int k : view) EXPECT_LE(std::abs(k - 3), 2) << k;
}

TEST_F(Hall, AnAdjustmentBringsFramesHomeThatErrByCentimetres) {
  for (int k = 1; k < frames_.size(); ++k) {
    Pose2 off = truth_[static_cast<std::size_t>(k)];
    off.x += k % 2 == 0 ? 0.04 : -0.03;
    off.y += k % 3 == 0 ? 0.03 : -0.02;
    off.theta += k % 2 == 0 ? 0.01 : -0.01;
    frames_.graph.place(k, off);
  }
  ASSERT_GT(worstError(), 0.04);
  adjust(frames_, 10);
  EXPECT_LT(worstError(), 0.01);
  EXPECT_EQ(frames_.graph.pose(0).x, truth_[0].x) << "the first one stays";
}

}  // namespace
}  // namespace cca
