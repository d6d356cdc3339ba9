// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/global_planner.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <utility>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "known_world.hpp"
#include "navigation/world/grid_paths.hpp"

namespace cca {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Squares of half a metre: two rooms, a door between them, and a pocket behind a wall.
const KnownWorld kTwoRooms{{"####################", "#........#.........#", "#........#.........#",
                            "#...#....#....#....#", "#...#.........#....#", "#...#.........######",
                            "#........#.........#", "#........#.........#", "####################"},
                           10};

/// A planner, with the world that it plans in.
struct Planning {
  WorldModel world;
  GlobalPlanner planner;
  GoalOutcome outcome;  ///< for the next step

  explicit Planning(const GlobalPlannerParameters& parameters = {}) : planner(parameters) {}

  const Plan& step(const Scan& scan, const Eigen::Vector2d& robot) {
    world.observe(scan, robot);
    return planner.update(world, robot, std::exchange(outcome, {}));
  }
  const Plan& plan() const { return planner.plan(); }
  void tell(GoalStatus status, const std::vector<Eigen::Vector2d>& lost_path = {}) {
    outcome = {plan().goal, status, lost_path};
  }
};

/// A step with a scan; calls until it is found out what is left to see.
const Plan& update(Planning& planner, const Scan& scan, const Eigen::Vector2d& robot) {
  const Plan* plan = &planner.step(scan, robot);
  for (int k = 0; k < 100 && plan->path.empty() && !plan->isFinished(); ++k)
    plan = &planner.step(scan, robot);
  return *plan;
}

struct Drive {
  double distance = 0.0;
  Plan last;
  std::vector<Eigen::Vector2d> goals;
};

/// A point that follows the plan, with a scan every 10 cm.
Drive drive(Planning& planner, const KnownWorld& world, Eigen::Vector2d robot,
            double longest = 300.0) {
  Drive drive;
  while (drive.distance < longest) {
    drive.last = update(planner, world.scanFrom({robot.x(), robot.y(), 0.0}, 4.0), robot);
    if (drive.last.isFinished()) break;
    if (drive.last.path.size() < 2) {
      ADD_FAILURE() << "neither a path nor finished";
      break;
    }
    drive.goals.push_back(drive.last.path.back());
    const Eigen::Vector2d step = drive.last.path[1] - robot;
    const double length = std::min(0.1, step.norm());
    if (length > 0.0) robot += length * step.normalized();
    drive.distance += std::max(length, 0.01);
  }
  return drive;
}

class EveryStrategy : public ::testing::TestWithParam<std::pair<const char*, Strategy>> {};

TEST_P(EveryStrategy, SeesTwoRoomsToTheLastSquareAndFinishes) {
  GlobalPlannerParameters parameters;
  parameters.strategy = GetParam().second;
  parameters.worth = 1e3;
  Planning planner(parameters);
  const Drive d = drive(planner, kTwoRooms, {1.0, 1.0});
  EXPECT_TRUE(d.last.isFinished());
  EXPECT_EQ(d.last.reason, "no reachable frontier of useful size is left");
  EXPECT_LT(d.last.unreachedArea(), 0.1);
  int unseen = 0;
  for (int y = 0; y < kTwoRooms.height(); ++y) {
    for (int x = 0; x < kTwoRooms.width(); ++x) {
      if (kTwoRooms.isOccupied({x, y})) continue;
      unseen += !isFree(planner.world.grid().at({x, y}));
    }
  }
  const double area = unseen * 0.05 * 0.05;
  EXPECT_LT(area, 0.5) << "m^2 of 28 unseen";
}

INSTANTIATE_TEST_SUITE_P(Strategies, EveryStrategy, ::testing::ValuesIn(kStrategyNames));

TEST(GlobalPlanner, ReasonsSayWhatAGoalPromisesWhereAndHowFarItIs) {
  Planning planner;
  const Eigen::Vector2d robot(1.2, 1.2);
  const Plan plan = update(planner, kTwoRooms.scanFrom({robot.x(), robot.y(), 0.0}, 4.0), robot);
  ASSERT_EQ(plan.phase, PlanPhase::kDriving);
  double area = 0.0, x = 0.0, y = 0.0, way = 0.0;
  EXPECT_EQ(std::sscanf(plan.reason.c_str(), "%lf m^2 behind (%lf, %lf), %lf m away; ", &area, &x,
                        &y, &way),
            4)
      << plan.reason;
  EXPECT_GT(area, 0.05);
  EXPECT_NEAR(x, plan.look_at.x(), 0.051);
  EXPECT_NEAR(y, plan.look_at.y(), 0.051);
  EXPECT_NEAR(way, (plan.path.back() - robot).norm(), 2.0);
}

/// Of a drive through the two rooms.
std::vector<ExplainedDecision> decisionsOf(Strategy strategy, Drive& drive_out) {
  GlobalPlannerParameters parameters;
  parameters.strategy = strategy;
  Planning planner(parameters);
  std::vector<ExplainedDecision> decisions;
  planner.planner.explainTo(
      [&](const ExplainedDecision& decision) { decisions.push_back(decision); });
  drive_out = drive(planner, kTwoRooms, {1.0, 1.0});
  return decisions;
}

TEST_P(EveryStrategy, ExplainsEachDecisionByTheBestOfItsCandidates) {
  const Strategy strategy = GetParam().second;
  Drive way;
  const auto decisions = decisionsOf(strategy, way);
  ASSERT_GT(decisions.size(), 2u);
  for (const ExplainedDecision& decision : decisions) {
    if (decision.rule == DecisionRule::kNone) continue;
    ASSERT_TRUE(decision.chosen);
    ASSERT_LT(*decision.chosen, decision.candidates.size());
    const Candidate& chosen = decision.candidates[*decision.chosen];
    for (const Candidate& other : decision.candidates) {
      EXPECT_GE(other.way + 0.3, (other.place_map - decision.robot_map).norm());
      EXPECT_GT(other.expected, 0.0);
      if (decision.rule != DecisionRule::kInPassing) {
        EXPECT_GE(chosen.score, other.score) << decision.reason;
      }
    }
  }
  const ExplainedDecision& last = decisions.back();
  EXPECT_EQ(last.rule, DecisionRule::kNone);
  EXPECT_FALSE(last.chosen);
  EXPECT_EQ(last.reason, way.last.reason);
}

TEST_P(EveryStrategy, DrivesTheSameWayWhereItsDecisionsAreExplained) {
  Drive explained;
  decisionsOf(GetParam().second, explained);
  GlobalPlannerParameters parameters;
  parameters.strategy = GetParam().second;
  Planning planner(parameters);
  EXPECT_EQ(drive(planner, kTwoRooms, {1.0, 1.0}).goals, explained.goals);
}

TEST(GlobalPlanner, FinishesAtOnceWhereAllIsInSight) {
  const KnownWorld room{{"######", "#....#", "#....#", "#....#", "######"}, 10};
  Planning planner;
  EXPECT_LT(drive(planner, room, {1.3, 1.2}).distance, 0.5);
}

/// Of 5 x 4 m, in squares of 5 cm, all floor known: what was not seen are faces of obstacles.
KnownWorld showFloor(Planning& planner, const std::vector<Cell>& obstacles) {
  KnownWorld room{std::vector<std::string>(80, "#" + std::string(98, '.') + "#")};
  room.rows.front() = room.rows.back() = std::string(100, '#');
  planner.world.seed(room.walls(), CellState::kOccupied);
  for (const Cell c : obstacles) {
    room.rows[79 - static_cast<std::size_t>(c.y)][static_cast<std::size_t>(c.x)] = '#';
  }
  planner.world.seed(room.freeCells(), CellState::kFree);
  return room;
}

TEST(GlobalPlanner, LooksAtTheFaceOfAWallThatWasNotSeen) {
  std::vector<Cell> wall;
  for (int y = 1; y < 55; ++y) wall.push_back({50, y});
  Planning planner;
  const KnownWorld room = showFloor(planner, wall);
  const Drive way = drive(planner, room, {1.2, 1.2});
  EXPECT_TRUE(way.last.isFinished());
  EXPECT_LT(way.distance, 6.0);
  int unseen = 0;
  for (const Cell c : wall) unseen += planner.world.isUnseen(c + Cell{1, 0});
  EXPECT_LE(unseen, 10) << "half a metre";
}

TEST(GlobalPlanner, DoesNotDriveAroundLegsOfFurnitureForTheirBacks) {
  std::vector<Cell> legs;
  for (int y = 20; y < 70; y += 15) {
    for (int x = 30; x < 90; x += 15) legs.push_back({x, y});
  }
  Planning planner;
  const KnownWorld room = showFloor(planner, legs);
  EXPECT_LT(drive(planner, room, {0.7, 0.7}).distance, 0.5);
}

// The window is too narrow to pass. From before it one sees to x = 5.2 m, from the start to 4.7 m.
TEST(GlobalPlanner, LooksAtLastAsFarAsItCanWhereItCannotGo) {
  const KnownWorld window{{"##################", "#....#...........#", "#................#",
                           "#....#...........#", "##################"},
                          9};
  Planning planner;
  EXPECT_TRUE(drive(planner, window, {1.4, 1.125}).last.isFinished());
  EXPECT_EQ(planner.world.grid().at(planner.world.grid().cellOf({5.15, 1.126})), CellState::kFree);
  EXPECT_GT(planner.plan().unreachedArea(), 0.5);
}

// It would take some calls to ask all places again.
TEST(GlobalPlanner, OnceFinishedStaysFinished) {
  const std::string wall = "#....#....................#", window = "#.........................#";
  const KnownWorld rooms{{std::string(27, '#'), wall, wall, wall, wall, window, wall, wall, wall,
                          wall, std::string(27, '#')},
                         9};
  Planning planner;
  EXPECT_TRUE(drive(planner, rooms, {1.4, 2.5}).last.isFinished());
  const Eigen::Vector2d robot = *planner.world.lastPlace();
  const Scan scan = rooms.scanFrom({robot.x(), robot.y(), 0.0}, 4.0);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(planner.step(scan, robot).isFinished()) << k;
}

// Whatever holds it: it drives to and fro, and does not get to where it wants to.
TEST(GlobalPlanner, EndsWhereDrivingShowsNothingNewForLong) {
  const KnownWorld hall{std::vector<std::string>(40, std::string(40, '.')), 10};
  Planning planner;
  const Eigen::Vector2d ends[] = {{10.0, 10.0}, {10.3, 10.0}};
  int steps = 0;
  for (; steps < 2000 && !planner.plan().isFinished(); ++steps) {
    const Eigen::Vector2d robot = ends[steps % 2];
    planner.step(hall.scanFrom({robot.x(), robot.y(), 0.0}, 4.0), robot);
  }
  EXPECT_GT(0.3 * steps, 100.0);  // m
  EXPECT_LT(0.3 * steps, 150.0);
  EXPECT_NE(planner.plan().reason.find("hardly anything new"), std::string::npos);
}

// Dozens of places promise a part of the room behind the window; each would take its time.
TEST(GlobalPlanner, WhereItIsHeldGivesUpAfterSixGoals) {
  const KnownWorld window{{"##################", "#....#...........#", "#................#",
                           "#....#...........#", "##################"},
                          11};
  const Eigen::Vector2d robot(1.7, 1.375);
  Planning planner;
  const Scan scan = window.scanFrom({robot.x(), robot.y(), 0.0}, 8.0);
  int given_up = 0;
  for (int k = 0; k < 100 && !update(planner, scan, robot).isFinished(); ++k) {
    given_up += planner.plan().phase == PlanPhase::kDriving;
    planner.tell(GoalStatus::kGivenUp);
  }
  EXPECT_TRUE(planner.plan().isFinished());
  EXPECT_EQ(given_up, 6);
  EXPECT_NE(planner.plan().reason.find("does not get to what is left"), std::string::npos);
}

// What stands beside the robot at the start is in nobody's memory.
TEST(GlobalPlanner, ANarrowLaserLooksAroundBeforeItFirstDrives) {
  Planning planner;
  Scan scan = kTwoRooms.scanFrom({1.0, 1.0, 0.0}, 4.0);
  scan.ranges.resize(scan.ranges.size() / 4);
  const std::size_t looks = 5;  // an eighth of a turn each
  for (std::size_t k = 0; k < looks; ++k) {
    EXPECT_EQ(planner.step(scan, {1.0, 1.0}).phase, PlanPhase::kLookingAround) << k;
    scan = kTwoRooms.scanFrom({1.0, 1.0, 0.25 * M_PI * static_cast<double>(k + 1)}, 4.0);
    scan.ranges.resize(scan.ranges.size() / 4);
  }
  planner.step(kTwoRooms.scanFrom({1.0, 1.0, M_PI}, 4.0), {1.0, 1.0});
  EXPECT_NE(planner.plan().phase, PlanPhase::kLookingAround);
  EXPECT_FALSE(planner.plan().path.empty());
}

TEST(GlobalPlanner, SaysSoWhereTheRobotIsShutIn) {
  const KnownWorld cell{{"###", "#.#", "###"}, 8};  // 0.4 m wide
  Planning planner;
  const Drive d = drive(planner, cell, {0.6, 0.6});
  EXPECT_TRUE(d.last.isFinished());
  EXPECT_EQ(d.last.reason, "the robot stands where nothing around it is known to be free");
}

TEST(GlobalPlanner, WaitsForAFirstScanAndAPose) {
  Planning planner;
  EXPECT_FALSE(planner.step(Scan{}, {0.0, 0.0}).isFinished());
  EXPECT_FALSE(planner.step(kTwoRooms.scanFrom({1.0, 1.0, 0.0}), {kNaN, 0.0}).isFinished());
  EXPECT_TRUE(planner.plan().path.empty());
  EXPECT_FALSE(planner.step(kTwoRooms.scanFrom({1.0, 1.0, 0.0}), {1.0, 1.0}).path.empty());
}

TEST(GlobalPlanner, GoalsThatItGetsStuckOnTheWayToRunOut) {
  for (const bool goes_around : {false, true}) {
    Planning planner;
    const Scan scan = kTwoRooms.scanFrom({1.0, 1.0, 0.0}, 4.0);
    std::vector<Eigen::Vector2d> goals;
    for (int i = 0; i < 100 && !update(planner, scan, {1.0, 1.0}).isFinished(); ++i) {
      goals.push_back(planner.plan().path.back());
      if (goes_around) {
        planner.tell(GoalStatus::kStuck, planner.plan().path);
      } else {
        planner.tell(GoalStatus::kGivenUp);
      }
    }
    EXPECT_TRUE(planner.plan().isFinished());
    EXPECT_GE(goals.size(), 1u);
  }
}

/// Two ways of 0.8 m width around a block; the lower one is the shorter one from below.
const KnownWorld kTwoWays{{"####################", "#..................#", "#..................#",
                           "#..##############..#", "#..##############..#", "#..##############..#",
                           "#..................#", "#..................#", "####################"},
                          8};

TEST(GlobalPlanner, WaysLeadAroundThePlaceWhereItGotStuckWhileThereIsAnother) {
  const Eigen::Vector2d robot(1.0, 0.8);
  const Scan scan = kTwoWays.scanFrom({robot.x(), robot.y(), 0.0}, 1.0);
  GlobalPlannerParameters parameters;
  parameters.worth = 1e3;  // m/m^2
  Planning planner(parameters);
  std::vector<Cell> known = kTwoWays.freeCells();
  const auto is_in_the_corner = [](Cell c) { return c.x > 140 && c.y < 24; };
  known.erase(std::remove_if(known.begin(), known.end(), is_in_the_corner), known.end());
  planner.world.seed(kTwoWays.walls(), CellState::kOccupied);
  planner.world.seed(known, CellState::kFree);
  const auto highest = [&] {
    double y = 0.0;
    for (const Eigen::Vector2d& corner : planner.plan().path) y = std::max(y, corner.y());
    return y;
  };
  planner.step(scan, robot);
  EXPECT_LT(highest(), 1.5);
  planner.tell(GoalStatus::kStuck, {{1.5, 0.8}, {7.0, 0.8}});
  planner.step(scan, robot);
  ASSERT_FALSE(planner.plan().path.empty());
  EXPECT_GT(highest(), 2.5);
  planner.tell(GoalStatus::kStuck, {{0.8, 1.5}, {0.8, 2.8}});
  update(planner, scan, robot);
  EXPECT_FALSE(planner.plan().path.empty()) << "where both are blocked they are tried again";
}

// It would have to come back for it.
TEST(GlobalPlanner, OnTheWayToAPromisingGoalWhatItPassesIsLookedAt) {
  const Eigen::Vector2d robot(8.0, 1.0);
  for (const bool passes_one : {false, true}) {
    Planning planner;
    const KnownWorld corridor = showCorridor(planner.world, {passes_one ? 56u : 20u});
    std::vector<Cell> beyond;
    for (int y = 0; y < corridor.height(); ++y) {
      for (int x = 280; x < corridor.width(); ++x) beyond.push_back({x, y});
    }
    planner.world.seed(beyond, CellState::kUnknown);
    update(planner, corridor.scanFrom({robot.x(), robot.y(), 0.0}, 3.0), robot);
    ASSERT_FALSE(planner.plan().path.empty());
    EXPECT_GT(planner.plan().look_at.x(), 10.0);
    EXPECT_EQ(planner.plan().look_at.y() > 1.8, passes_one) << "behind the wall";
  }
}

TEST(GlobalPlanner, AWayHomeLeadsAlongABlockedPlaceWhereThereIsNoOther) {
  Planning planner;
  planner.world.seed(kTwoWays.walls(), CellState::kOccupied);
  planner.world.seed(kTwoWays.freeCells(), CellState::kFree);
  const Eigen::Vector2d from(1.0, 0.8), to(6.8, 0.8);
  const auto length = [&](const std::vector<Eigen::Vector2d>& lost_path) {
    return pathLength(planner.planner.pathTo(planner.world, from, to, lost_path));
  };
  const double lower = length({});
  EXPECT_NEAR(lower, 5.8, 0.1);
  EXPECT_GT(length({{4.0, 0.8}, {7.0, 0.8}}), 8.0);
  EXPECT_GT(length({}), 8.0);
  EXPECT_NEAR(length({{4.0, 2.8}, {7.0, 2.8}}), lower, 1e-9);
}

TEST(GlobalPlanner, LeavesAGoalWhoseWayIsLostTwice) {
  const Eigen::Vector2d robot(1.0, 1.0);
  const Scan scan = kTwoRooms.scanFrom({robot.x(), robot.y(), 0.0}, 4.0);
  Planning planner;
  int goals = 0;
  for (; goals < 100 && !update(planner, scan, robot).isFinished(); ++goals) {
    const Eigen::Vector2d goal_map = planner.plan().path.back();
    if ((goal_map - robot).norm() < 0.6) {  // shut, it would shut in the robot
      planner.tell(GoalStatus::kReached);
      continue;
    }
    const Cell goal = planner.world.grid().cellOf(goal_map);
    std::vector<Cell> shut;
    for (int y = -2; y <= 2; ++y) {
      for (int x = -2; x <= 2; ++x) {
        const Cell c = goal + Cell{x, y};
        if (planner.world.grid().at(c) == CellState::kFree) shut.push_back(c);
      }
    }
    planner.world.seed(shut, CellState::kOccupied);
    planner.step(scan, robot);
    planner.world.seed(shut, CellState::kFree);
  }
  EXPECT_TRUE(planner.plan().isFinished());
  EXPECT_GT(goals, 0);
}

TEST(GlobalPlanner, KeepsItsGoalsWithinItsLimits) {
  Planning planner;
  planner.planner.limitTo({{0.0, 0.0}, {4.6, 0.0}, {4.6, 4.5}, {0.0, 4.5}});  // the left room
  const Drive limited = drive(planner, kTwoRooms, {1.0, 1.0});
  EXPECT_TRUE(limited.last.isFinished());
  for (const auto& goal : limited.goals) EXPECT_LT(goal.x(), 4.6);
}

TEST(GlobalPlanner, HasNothingToDoInAPlaceKnownFromASavedMap) {
  Planning planner;
  std::vector<Cell> free, occupied;
  for (int y = -1; y <= kTwoRooms.height(); ++y) {
    for (int x = -1; x <= kTwoRooms.width(); ++x)
      (kTwoRooms.isOccupied({x, y}) ? occupied : free).push_back({x, y});
  }
  planner.world.seed(occupied, CellState::kOccupied);
  planner.world.seed(free, CellState::kFree);
  EXPECT_TRUE(update(planner, kTwoRooms.scanFrom({1.0, 1.0, 0.0}, 4.0), {1.0, 1.0}).isFinished());
}

// Made anew from its first scan alone, a place that was seen whole is to be seen again.
TEST(GlobalPlanner, AsksAllPlacesAgainWhereThePastWasCorrected) {
  Planning planner;
  ASSERT_TRUE(drive(planner, kTwoRooms, {1.0, 1.0}).last.isFinished());
  const std::size_t all = planner.world.grid().revealed();
  PastScans past;
  const Scan scan = kTwoRooms.scanFrom({1.0, 1.0, 0.0}, 4.0);
  past.add({scan, rangeNoise(scan), {}}, {1.0, 1.0, 0.0});
  past.correct({{1.0, 1.0, 0.0}}, {true});
  planner.planner.correct(planner.world, past, planner.world.correct(past));
  ASSERT_LT(planner.world.grid().revealed(), all / 2);
  EXPECT_TRUE(drive(planner, kTwoRooms, {1.0, 1.0}).last.isFinished());
  EXPECT_GT(planner.world.grid().revealed(), all - all / 50);
}

TEST(GlobalPlanner, IsDeterministic) {
  Planning a, b;
  const Drive first = drive(a, kTwoRooms, {1.0, 1.0}), second = drive(b, kTwoRooms, {1.0, 1.0});
  EXPECT_EQ(first.distance, second.distance);
  EXPECT_EQ(first.goals, second.goals);
}

}  // namespace
}  // namespace cca
