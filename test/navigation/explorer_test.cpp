// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/explorer.hpp"

#include <gtest/gtest.h>

#include "known_world.hpp"

namespace cca {
namespace {

const KnownWorld kRooms{{"##############", "#......#.....#", "#......#.....#", "#............#",
                         "#............#", "#......#.....#", "##############"},
                        10};
/// The right room is seen whole only from inside.
const KnownWorld kTwoDoors{
    {"################", "#.......#......#", "#..............#", "#..............#",
     "#.......#......#", "#.......#......#", "#.......####...#", "#.......#......#",
     "#.......#...####", "#..............#", "#..............#", "################"},
    10};
const Pose2 kStart{1.0, 1.0, 0.0};

/// The beams of a scan up to `half` rad from straight ahead.
Scan ahead(const Scan& scan, double half) {
  Scan narrow = scan;
  narrow.ranges.clear();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (std::abs(scan.bearing(i)) > half) continue;
    if (narrow.ranges.empty()) narrow.angle_min = scan.bearing(i);
    narrow.ranges.push_back(scan.ranges[i]);
  }
  return narrow;
}

/// A robot that drives exactly as it is told, at 10 Hz.
struct Driver {
  Explorer explorer;
  Pose2 T_map_robot = kStart;
  Velocity velocity;
  double time = 0.0, distance = 0.0;
  double half_view = M_PI;  // rad

  const KnownWorld& world;

  explicit Driver(const ExplorerParameters& parameters = {}, const KnownWorld& place = kRooms)
      : explorer({}, {}, parameters), world(place) {}

  Action step() {
    const Scan scan = ahead(world.scanFrom(T_map_robot, 4.0), half_view);
    const Action action = explorer.step({scan, T_map_robot, velocity, time});
    velocity = action.velocity;
    constexpr double kPeriod = 0.1;
    const Eigen::Vector2d way = kPeriod * velocity.linear * T_map_robot.heading();
    T_map_robot = {T_map_robot.x + way.x(), T_map_robot.y + way.y(),
                   wrapAngle(T_map_robot.theta + kPeriod * velocity.angular)};
    distance += way.norm();
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

// It begins with its nose to a wall: nothing that it could stand on is known until it turns.
TEST(Explorer, WithANarrowViewLooksAroundBeforeItSaysThatNothingIsLeft) {
  for (const double half_view : {0.4, 0.8, 1.57, 2.4}) {
    Driver driver;
    driver.half_view = half_view;
    driver.T_map_robot = {0.9, 1.0, M_PI};
    EXPECT_EQ(driver.run().status, ExplorationStatus::kFinished);
    for (const Cell c : {Cell{120, 20}, Cell{120, 50}, Cell{30, 50}})
      EXPECT_EQ(driver.explorer.grid().at(c), CellState::kFree) << half_view << ": " << c.x;
  }
}

// The way that it brakes on was found safe, and turning would bend it.
TEST(Explorer, WithANarrowViewStopsBeforeItTurnsToLook) {
  Driver driver;
  driver.half_view = M_PI / 4;
  driver.velocity = {0.5, 0.0};
  bool has_turned = false;
  for (int i = 0; i < 20; ++i) {
    const double speed = driver.velocity.linear;
    const Action action = driver.step();
    EXPECT_LE(action.velocity.linear, speed);
    if (speed > 0.01) {
      EXPECT_EQ(action.velocity.angular, 0.0);
    }
    has_turned = has_turned || action.velocity.angular > 0.0;
  }
  EXPECT_TRUE(has_turned);
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

/// A robot that believes itself more and more astray, until it is told where it has been.
struct StrayingDriver {
  Explorer explorer;
  PastScans past;
  std::vector<Pose2> truth;
  Pose2 T_map_robot = kStart;
  Pose2 T_map_true;  ///< the belief's error
  Velocity velocity;
  double time = 0.0;

  explicit StrayingDriver(const ExplorerParameters& parameters) : explorer({}, {}, parameters) {}

  Action step(double stray) {
    Scan scan = kRooms.scanFrom(T_map_robot, 4.0);
    T_map_true = T_map_true * Pose2{stray, 0.5 * stray, 0.2 * stray};
    scan.T_map_sensor = T_map_true * T_map_robot;
    const Action action = explorer.step({scan, scan.T_map_sensor, velocity, time});
    past.add(scan, scan.T_map_sensor);
    truth.push_back(T_map_robot);
    velocity = action.velocity;
    constexpr double kPeriod = 0.1;
    const Eigen::Vector2d way = kPeriod * velocity.linear * T_map_robot.heading();
    T_map_robot = {T_map_robot.x + way.x(), T_map_robot.y + way.y(),
                   wrapAngle(T_map_robot.theta + kPeriod * velocity.angular)};
    time += kPeriod;
    return action;
  }
  void correct() {
    past.correct(truth);
    explorer.correctMap(past);
    explorer.correctNavigation(past);
    T_map_true = {};
  }
};

TEST(Explorer, MakesItsMapAnewAndFindsHomeWhereThePastIsCorrected) {
  ExplorerParameters parameters;
  parameters.return_to_start = true;
  StrayingDriver driver(parameters);
  for (int i = 0; i < 60; ++i) driver.step(0.01);
  ASSERT_GT(driver.T_map_true.position().norm(), 0.5);
  driver.correct();
  Action action;
  for (int i = 0; i < 4000 && action.status != ExplorationStatus::kFinished; ++i)
    action = driver.step(0.0);
  EXPECT_EQ(action.status, ExplorationStatus::kFinished);
  EXPECT_NE(action.reason.find("back at the start"), std::string::npos) << action.reason;
  EXPECT_LT((driver.T_map_robot.position() - kStart.position()).norm(), 0.35);
  const ExplorationGrid& grid = driver.explorer.grid();
  EXPECT_EQ(grid.at({120, 20}), CellState::kFree);
  int astray = 0;  // of the walls, more than a cell inside of a room
  for (const Cell c : kRooms.freeCells()) {
    bool is_inside = grid.at(c) == CellState::kOccupied;
    for (const Cell offset : kNeighbours) is_inside = is_inside && !kRooms.isOccupied(c + offset);
    astray += is_inside;
  }
  EXPECT_EQ(astray, 0);
  for (const MapLine& line : driver.explorer.lineMap().lines()) {
    const Eigen::Vector2d way = line.segment.end - line.segment.start;
    EXPECT_LT(std::min(std::abs(way.x()), std::abs(way.y())), 0.05);
  }
}

TEST(Explorer, DrivesOnAsItDidWhereThePastIsCorrected) {
  StrayingDriver corrected({}), other({});
  corrected.T_map_true = other.T_map_true = {0.5, -0.3, 0.4};
  for (int i = 0; i < 15 || (i < 100 && corrected.velocity.linear < 0.3); ++i) {
    corrected.step(0.0);
    other.step(0.0);
  }
  ASSERT_GE(corrected.velocity.linear, 0.3);
  corrected.correct();
  const Action with = corrected.step(0.0), without = other.step(0.0);
  EXPECT_NEAR(with.velocity.linear, without.velocity.linear, 0.05);
  EXPECT_NEAR(with.velocity.angular, without.velocity.angular, 0.2);
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

// Glass across one of two doors: the laser sees through, the robot gets no farther.
TEST(Explorer, TakesTheOtherDoorWhereSomethingUnseenHoldsIt) {
  ExplorerParameters parameters;
  parameters.return_to_start = true;
  Driver driver(parameters, kTwoDoors);
  driver.T_map_robot = {3.0, 1.0, 0.0};
  int against_the_glass = 0;
  Action action;
  for (int i = 0; i < 6000 && action.status != ExplorationStatus::kFinished; ++i) {
    const Pose2 before = driver.T_map_robot;
    action = driver.step();
    const Eigen::Vector2d now = driver.T_map_robot.position();
    const bool is_at_the_glass = now.y() < 2.0 && std::abs(now.x() - 4.25) < 0.5;
    if (!is_at_the_glass) continue;
    ++against_the_glass;
    driver.T_map_robot = {before.x, before.y, driver.T_map_robot.theta};
    driver.velocity.linear = 0.0;
  }
  EXPECT_EQ(action.status, ExplorationStatus::kFinished);
  EXPECT_NE(action.reason.find("back at the start"), std::string::npos) << action.reason;
  EXPECT_GT(against_the_glass, 50) << "it should have tried";
  // A minute and a half. Without other ways around the glass it was almost five.
  EXPECT_LT(against_the_glass, 1200);
  for (const Cell c : {Cell{140, 20}, Cell{140, 100}, Cell{100, 40}})
    EXPECT_EQ(driver.explorer.grid().at(c), CellState::kFree) << c.x << ", " << c.y;
}

TEST(Explorer, RefusesAPathThatIsNone) {
  ExplorerParameters parameters;
  parameters.path = "straight";
  EXPECT_THROW(Explorer({}, {}, parameters), std::runtime_error);
}

}  // namespace
}  // namespace cca
