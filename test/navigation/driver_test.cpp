// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "known_world.hpp"
#include "navigation/control/delegated_driver.hpp"
#include "navigation/control/tangent_bug_driver.hpp"
#include "navigation/planning/global_planner.hpp"

namespace cca::driver_test {
namespace {

const KnownWorld kHall{std::vector<std::string>(20, std::string(20, '.')), 10};  // 10 x 10 m
const Pose2 kRobot{2.0, 5.0, 0.0};
const WorldModel kNothingKnown;

Observation seenAt(double time, const Pose2& T_map_robot = kRobot) {
  return {kHall.scanFrom(T_map_robot, 4.0), T_map_robot, {}, time};
}

DriveTask taskTo(int goal, const Eigen::Vector2d& p_map) {
  DriveTask task;
  task.goal = goal;
  task.p_map = p_map;
  task.path = {kRobot.position(), p_map};
  task.look_at_map = p_map + Eigen::Vector2d(0.0, 1.0);
  return task;
}

TEST(DelegatedDriver, TellsOnceWhatHasBecomeOfTheGoal) {
  DelegatedDriver driver{RobotParameters{}};
  for (const auto& [outcome, status] : {std::pair{DriveOutcome::kReached, GoalStatus::kReached},
                                        std::pair{DriveOutcome::kFailed, GoalStatus::kGivenUp}}) {
    const auto command = driver.drive(taskTo(7, {5.0, 5.0}), seenAt(0.0), kNothingKnown);
    ASSERT_TRUE(command.T_map_goal);
    EXPECT_NEAR(command.T_map_goal->theta, M_PI / 2.0, 1e-9) << "where it is to look";
    EXPECT_EQ(driver.takeOutcome().status, GoalStatus::kUnderWay);
    driver.noteOutcome(outcome);
    const GoalOutcome told = driver.takeOutcome();
    EXPECT_EQ(told.goal, 7);
    EXPECT_EQ(told.status, status);
    EXPECT_TRUE(told.lost_path.empty());
    EXPECT_EQ(driver.takeOutcome().status, GoalStatus::kUnderWay);
  }
}

TEST(DelegatedDriver, GivesUpAGoalWhoseTimeIsOverButNotForStandingByOrder) {
  DelegatedDriver driver{RobotParameters{}};
  driver.drive(taskTo(1, {2.7, 5.0}), seenAt(0.0), kNothingKnown);  // 35 s
  driver.noteOutcome(DriveOutcome::kFailed);
  driver.pauseTimers(100.0);
  EXPECT_EQ(driver.takeOutcome().status, GoalStatus::kUnderWay) << "it was to stand";
  driver.drive(taskTo(1, {2.7, 5.0}), seenAt(134.0), kNothingKnown);
  EXPECT_EQ(driver.takeOutcome().status, GoalStatus::kUnderWay);
  driver.drive(taskTo(1, {2.7, 5.0}), seenAt(136.0), kNothingKnown);
  EXPECT_EQ(driver.takeOutcome().status, GoalStatus::kGivenUp);
}

TEST(DelegatedDriver, LooksAroundInThreeTurns) {
  DelegatedDriver driver{RobotParameters{}};
  DriveTask task = taskTo(Plan::kLookAround, kRobot.position());
  task.looks_around = true;
  double turned = 0.0, heading = kRobot.theta;
  for (int k = 0; k < 3; ++k) {
    const auto command = driver.drive(task, seenAt(k), kNothingKnown);
    ASSERT_TRUE(command.T_map_goal);
    const double turn = wrapAngle(command.T_map_goal->theta - heading);
    EXPECT_GT(turn, 0.5);
    turned += turn;
    heading = command.T_map_goal->theta;
    driver.noteOutcome(DriveOutcome::kReached);
    EXPECT_EQ(driver.takeOutcome().status, GoalStatus::kUnderWay);
  }
  EXPECT_NEAR(turned, 2.0 * M_PI, 1e-9);
}

TEST(TangentBugDriver, TellsWhereARobotThatIsHeldGotNoFarther) {
  TangentBugDriver driver{RobotParameters{}};
  GoalOutcome outcome;
  double time = 0.0;
  for (; time < 60.0 && outcome.status == GoalStatus::kUnderWay; time += 0.1) {
    const auto command = driver.drive(taskTo(3, {6.0, 5.0}), seenAt(time), kNothingKnown);
    EXPECT_GT(command.velocity.linear, 0.0);
    EXPECT_FALSE(command.T_map_goal);
    outcome = driver.takeOutcome();
  }
  EXPECT_EQ(outcome.status, GoalStatus::kStuck);
  EXPECT_EQ(outcome.goal, 3);
  ASSERT_EQ(outcome.lost_path.size(), 2u);
  EXPECT_EQ(outcome.lost_path.front(), kRobot.position());
  EXPECT_NEAR(time, 10.0 + 2.0 * M_PI / RobotParameters{}.max_angular_velocity, 0.5);
}

TEST(TangentBugDriver, WaitsForAPathAndGivesUpWhenTheTimeIsOver) {
  TangentBugDriver driver{RobotParameters{}};
  DriveTask task = taskTo(3, {6.0, 5.0});
  task.has_path = false;
  for (const double time : {0.0, 20.0, 50.0}) {
    EXPECT_EQ(driver.drive(task, seenAt(time), kNothingKnown).velocity.linear, 0.0);
    EXPECT_EQ(driver.takeOutcome().status, GoalStatus::kUnderWay) << time;
  }
  driver.drive(task, seenAt(70.0), kNothingKnown);
  EXPECT_EQ(driver.takeOutcome().status, GoalStatus::kGivenUp);
}

// The last word on the velocity is the driver's; its robot changes, radius and margin do not.
TEST(TangentBugDriver, HoldsTheParametersThatItIsTold) {
  TangentBugDriver driver{RobotParameters{}};
  RobotParameters slow;
  slow.max_linear_velocity = 0.1;
  driver.changeMotion(driver.actuation().robot().movingAs(slow));
  EXPECT_EQ(driver.actuation().robot().max_linear_velocity, 0.1);
  double fastest = 0.0;
  for (double time = 0.0; time < 3.0; time += 0.1) {
    const auto command = driver.drive(taskTo(1, {6.0, 5.0}), seenAt(time), kNothingKnown);
    fastest = std::max(fastest, command.velocity.linear);
  }
  EXPECT_NEAR(fastest, 0.1, 1e-9);
}

}  // namespace
}  // namespace cca::driver_test
