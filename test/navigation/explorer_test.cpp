// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/explorer.hpp"

#include <gtest/gtest.h>

#include "known_world.hpp"

namespace cca {
namespace {

const KnownWorld kRooms{{"##############", "#......#.....#", "#......#.....#", "#............#",
                         "#............#", "#......#.....#", "##############"},
                        10};
const Pose2 kStart{1.0, 1.0, 0.0};

/// A robot that drives exactly as it is told, at 10 Hz.
struct Driver {
  Explorer explorer;
  Pose2 T_map_robot = kStart;
  Velocity velocity;
  double time = 0.0, distance = 0.0;

  explicit Driver(const ExplorerParameters& parameters = {}) : explorer({}, {}, parameters) {}

  Action step() {
    const Action action =
        explorer.step({kRooms.scanFrom(T_map_robot, 4.0), T_map_robot, velocity, time});
    velocity = action.velocity;
    constexpr double kPeriod = 0.1;
    const Eigen::Vector2d ahead = kPeriod * velocity.linear * T_map_robot.heading();
    T_map_robot = {T_map_robot.x + ahead.x(), T_map_robot.y + ahead.y(),
                   wrapAngle(T_map_robot.theta + kPeriod * velocity.angular)};
    distance += ahead.norm();
    time += kPeriod;
    return action;
  }

  Action run(int most_steps = 4000) {
    Action action;
    for (int i = 0; i < most_steps && action.status != ExplorationStatus::kFinished; ++i)
      action = step();
    return action;
  }
};

TEST(Explorer, ExploresTwoRoomsFinishesAndSaysWhy) {
  Driver driver;
  const Action last = driver.run();
  EXPECT_EQ(last.status, ExplorationStatus::kFinished);
  EXPECT_EQ(last.reason, "no reachable frontier of useful size is left");
  EXPECT_EQ(driver.explorer.grid().at({120, 20}), CellState::kFree);
  EXPECT_LT(driver.distance, 25.0);
  EXPECT_EQ(driver.velocity.linear, 0.0);
}

TEST(Explorer, AlsoFinishesByTangentBugAlone) {
  ExplorerParameters parameters;
  parameters.path = "paper";
  Driver driver(parameters);
  EXPECT_EQ(driver.run().status, ExplorationStatus::kFinished);
  EXPECT_EQ(driver.explorer.grid().at({120, 20}), CellState::kFree);
}

TEST(Explorer, ReturnsToItsStartWhereAsked) {
  ExplorerParameters parameters;
  parameters.return_to_start = true;
  Driver driver(parameters);
  const Action last = driver.run();
  EXPECT_EQ(last.status, ExplorationStatus::kFinished);
  EXPECT_NE(last.reason.find("back at the start"), std::string::npos) << last.reason;
  EXPECT_LT((driver.T_map_robot.position() - kStart.position()).norm(), 0.35);
}

TEST(Explorer, StandsStillWhilePausedAndGoesOnAfterwards) {
  Driver driver;
  for (int i = 0; i < 20; ++i) driver.step();
  driver.explorer.pause(true);
  for (int i = 0; i < 600; ++i) {
    const Action action = driver.step();
    EXPECT_EQ(action.status, ExplorationStatus::kPaused);
    EXPECT_EQ(action.velocity.linear, 0.0);
  }
  driver.explorer.pause(false);
  EXPECT_EQ(driver.run().status, ExplorationStatus::kFinished);
  EXPECT_EQ(driver.explorer.grid().at({120, 20}), CellState::kFree);
}

TEST(Explorer, GivesUpGoalsThatARobotWhichCannotMoveDoesNotReach) {
  Explorer explorer({}, {}, {});
  const Scan scan = kRooms.scanFrom(kStart, 4.0);
  Action action;
  double time = 0.0;
  for (int i = 0; i < 20000 && action.status != ExplorationStatus::kFinished; ++i, time += 1.0)
    action = explorer.step({scan, kStart, {}, time});
  EXPECT_EQ(action.status, ExplorationStatus::kFinished);
}

TEST(Explorer, RefusesAPathThatIsNone) {
  ExplorerParameters parameters;
  parameters.path = "straight";
  EXPECT_THROW(Explorer({}, {}, parameters), std::runtime_error);
}

}  // namespace
}  // namespace cca
