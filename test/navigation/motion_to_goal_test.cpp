// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/tangent_bug/motion_to_goal.hpp"

#include <gtest/gtest.h>

namespace cca::motion_to_goal_test {
namespace {

// A wall of points between the robot at the origin and the goal at (4, 0).
ConfigurationSpace wallAhead() {
  ConfigurationSpace space;
  space.radius = 0.3;
  for (double y = -1.0; y <= 1.0; y += 0.05) space.obstacles.push_back({2.0, y});
  return space;
}

const Eigen::Vector2d kRobot(0, 0), kGoal(4, 0);

TEST(MotionToGoal, HeadsStraightForAGoalInSight) {
  MotionToGoal motion;
  EXPECT_EQ(*motion.step(kRobot, kGoal, {{}, 0.3}, {}, 8.0), kGoal);
}

TEST(MotionToGoal, HeadsForTheHorizonWhereTheGoalIsBeyondIt) {
  MotionToGoal motion;
  EXPECT_EQ(*motion.step(kRobot, {20, 0}, {{}, 0.3}, {}, 8.0), Eigen::Vector2d(8, 0));
}

TEST(MotionToGoal, ChoosesByTheWholeWayNotByTheNodesDistanceToTheGoal) {
  // The far node is nearer to the goal (3.2 < 3.4), but the way over it is longer.
  const TangentNode near{{1.0, 1.6}, {1.0, 1.3}, true}, far{{2.0, -2.5}, {2.0, -2.2}, false};
  MotionToGoal motion;
  EXPECT_EQ(*motion.step(kRobot, kGoal, wallAhead(), {far, near}, 8.0), near.p_map);
}

TEST(MotionToGoal, EndsWhereTheHeuristicRises) {
  const TangentNode node{{2.0, 1.4}, {2.0, 1.1}, true}, detour{{2.0, 3.0}, {2.0, 2.7}, true};
  MotionToGoal motion;
  EXPECT_TRUE(motion.step(kRobot, kGoal, wallAhead(), {node}, 8.0));
  EXPECT_FALSE(motion.step(kRobot, kGoal, wallAhead(), {detour}, 8.0));
}

TEST(MotionToGoal, ForgetsTheHeuristicOnLeavingABoundary) {
  const TangentNode node{{2.0, 1.4}, {2.0, 1.1}, true}, detour{{2.0, 3.0}, {2.0, 2.7}, true};
  MotionToGoal motion;
  motion.step(kRobot, kGoal, wallAhead(), {node}, 8.0);
  motion.startFromBoundary(kRobot, 10.0, true);
  EXPECT_TRUE(motion.step(kRobot, kGoal, wallAhead(), {detour}, 8.0));
}

TEST(MotionToGoal, GoesFirstToThePlaceThatWasNearerThanTheBoundary) {
  MotionToGoal motion;
  const Eigen::Vector2d reach(0.0, 2.0);
  motion.startFromBoundary(reach, 3.5, true);
  EXPECT_EQ(*motion.step(kRobot, kGoal, wallAhead(), {}, 8.0), reach);
}

TEST(MotionToGoal, SaysWhereAPlaceWasNotAsNearAsItHadLooked) {
  MotionToGoal motion;
  motion.startFromBoundary(kRobot, 3.5, true);
  EXPECT_FALSE(motion.step(kRobot, kGoal, wallAhead(), {}, 8.0));
  EXPECT_EQ(*motion.reachedInVain(), kRobot);
}

// Seen from nearer, the end of the wall is at 1.05 m instead of 1.00.
TEST(MotionToGoal, TakesAnotherPlaceThatKeepsThePromiseWhereACornerHidesTheFirst) {
  MotionToGoal motion;
  const Eigen::Vector2d hidden(3.0, 1.7), beside(3.0, 2.2), farther(0.0, 2.0);
  ConfigurationSpace space = wallAhead();
  space.obstacles.push_back({2.0, 1.05});
  motion.startFromBoundary(hidden, 2.5, true);
  motion.correctPlace(kRobot, kGoal, space, farther);
  EXPECT_FALSE(motion.step(kRobot, kGoal, space, {}, 8.0));
  EXPECT_EQ(*motion.reachedInVain(), hidden);
  motion.startFromBoundary(hidden, 2.5, true);
  motion.correctPlace(kRobot, kGoal, space, beside);
  EXPECT_EQ(*motion.step(kRobot, kGoal, space, {}, 8.0), beside);
  EXPECT_FALSE(motion.reachedInVain());
}

TEST(MotionToGoal, KeepsAPlaceOnTheEdgeOfWhatIsFree) {
  const ConfigurationSpace space = wallAhead();
  for (const double deeper : {0.0, 0.01, -0.01}) {
    MotionToGoal motion;
    const Eigen::Vector2d edge(2.0 - space.radius + deeper, 0.0);
    motion.startFromBoundary(edge, 3.0, true);
    EXPECT_TRUE(motion.step(kRobot, kGoal, space, {}, 8.0)) << deeper;
  }
}

TEST(MotionToGoal, KeepsToItsSideUntilTheOtherPromisesClearlyMore) {
  const TangentNode right{{2.0, 1.4}, {2.0, 1.1}, true};
  const TangentNode left{{2.0, -1.3}, {2.0, -1.0}, false}, better{{1.0, -0.2}, {1.0, 0.1}, false};
  MotionToGoal motion;
  EXPECT_EQ(*motion.step(kRobot, kGoal, wallAhead(), {right}, 8.0), right.p_map);
  EXPECT_EQ(*motion.step(kRobot, kGoal, wallAhead(), {right, left}, 8.0), right.p_map);
  EXPECT_EQ(*motion.step(kRobot, {4, -1}, wallAhead(), {right, better}, 8.0), better.p_map);
}

TEST(MotionToGoal, AtTheGoalStaysThere) {
  MotionToGoal motion;
  EXPECT_EQ(*motion.step(kGoal, kGoal, wallAhead(), {}, 8.0), kGoal);
}

}  // namespace
}  // namespace cca::motion_to_goal_test
