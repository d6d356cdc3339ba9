// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

const Eigen::Matrix3d kInformation = Eigen::Vector3d(1e4, 1e4, 4e4).asDiagonal();

/// Poses on a square of 10 m a side, as wheels that turn long have them.
PoseGraph drifted(double drift) {
  PoseGraph graph;
  Pose2 pose;
  graph.add(pose);
  for (int k = 1; k < 40; ++k) {
    const Pose2 truth{1.0, 0.0, k % 10 == 0 ? M_PI_2 : 0.0};
    const Pose2 step{1.0, 0.0, truth.theta + drift};
    pose = pose * step;
    graph.add(pose);
    graph.connect({k - 1, k, step, kInformation, EdgeKind::kWheels});
  }
  return graph;
}

TEST(PoseGraph, ANewLoopBringsTheSquareBackTogether) {
  PoseGraph graph = drifted(0.01);
  EXPECT_GT((graph.pose(39).position() - Eigen::Vector2d(0.0, 1.0)).norm(), 1.0);
  graph.connect({39, 0, {1.0, 0.0, M_PI_2}, 100.0 * kInformation, EdgeKind::kLoop});
  graph.settle(true);
  EXPECT_LT((graph.pose(39).position() - Eigen::Vector2d(0.0, 1.0)).norm(), 0.1);
  EXPECT_EQ(graph.pose(0).x, 0.0) << "the first stays";
}

TEST(PoseGraph, ASettlementIsTakenStepByStepWhileTheGraphGrows) {
  PoseGraph graph = drifted(0.01);
  graph.connect({39, 0, {1.0, 0.0, M_PI_2}, 100.0 * kInformation, EdgeKind::kLoop});
  PoseGraph at_once = graph;
  at_once.settle(true);
  Settlement settlement(graph, true);
  int steps = 1;
  while (!settlement.advance()) ++steps;
  EXPECT_GT(steps, 2);
  EXPECT_LT(steps, 20);
  const Pose2 last_before = graph.pose(39), step{0.7, 0.1, 0.2};
  EXPECT_GT((last_before.position() - Eigen::Vector2d(0.0, 1.0)).norm(), 1.0) << "none has moved";
  const int newer = graph.add(last_before * step);
  graph.connect({39, newer, step, kInformation, EdgeKind::kWheels});
  const int apart = graph.add({50.0, 0.0, 0.0});  // a part of its own
  settlement.applyTo(graph);
  for (int k = 0; k < at_once.size(); ++k) {
    EXPECT_EQ(graph.pose(k).x, at_once.pose(k).x);
    EXPECT_EQ(graph.pose(k).theta, at_once.pose(k).theta);
  }
  const Pose2 carried = graph.pose(39).inverse() * graph.pose(newer);
  EXPECT_NEAR(carried.x, step.x, 1e-9);
  EXPECT_NEAR(carried.theta, step.theta, 1e-9);
  EXPECT_EQ(graph.pose(apart).x, 50.0);
}

TEST(PoseGraph, OneFalseLoopAmongTrueOnesIsOutvoted) {
  PoseGraph graph = drifted(0.0);
  graph.connect({39, 0, {1.0, 0.0, M_PI_2}, kInformation, EdgeKind::kLoop});
  graph.connect({38, 0, {2.0, 0.0, M_PI_2}, kInformation, EdgeKind::kLoop});
  graph.connect({35, 5, {4.0, 3.0, 0.5}, kInformation, EdgeKind::kLoop});  // false
  graph.settle(false);
  EXPECT_LT((graph.pose(20).position() - Eigen::Vector2d(10.0, 10.0)).norm(), 0.3);
}

TEST(PoseGraph, SurroundingsGrowLessCertainAlongTheWay) {
  PoseGraph graph;
  graph.add({});
  for (int k = 1; k < 40; ++k) {
    graph.add({static_cast<double>(k), 0.0, 0.0});
    graph.connect({k - 1, k, {1.0, 0.0, 0.0}, kInformation, EdgeKind::kWheels});
  }
  const auto all = graph.surroundings(0, 100.0);
  ASSERT_EQ(all.size(), 40u);
  double last = -1.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k].node, static_cast<int>(k));
    EXPECT_GT(all[k].position, last);
    last = all[k].position;
  }
  EXPECT_LT(graph.surroundings(0, 0.05).size(), 20u);
}

TEST(PoseGraph, NothingMovesWhereNothingIsKnown) {
  PoseGraph graph;
  graph.settle(true);
  graph.add({});
  graph.add({1.0, 2.0, 3.0});
  graph.settle(true);
  EXPECT_EQ(graph.pose(1).x, 1.0);
}

}  // namespace
}  // namespace cca
