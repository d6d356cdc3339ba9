// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/tangent_bug/tangent_bug.hpp"

#include <gtest/gtest.h>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "tangent_run.hpp"
#include "traps.hpp"

namespace cca::testing {
namespace {

constexpr double kPeriod = 0.1;

TEST(TangentBug, DrivesStraightToAGoalInTheOpen) {
  const TangentRun end = run(BoxWorld{}, {0, 0, 0}, {5, 0});
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_LT(end.distance, 5.02);
}

TEST(TangentBug, TurnsOnTheSpotForAGoalBehind) {
  const TangentRun end = run(BoxWorld{}, {0, 0, 0}, {-5, 0});
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_LT(end.distance, 5.1);
}

TEST(TangentBug, CutsACornerCloseToTheShortestPath) {
  BoxWorld world;
  world.addFrame(10, 10);
  world.add(0, 4.5, 6, 5.5);
  const TangentRun end = run(world, {1, 2, 0}, {1, 8});
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_GE(end.clearance, 0.25);
  EXPECT_LT(end.distance, 13.1);  // 12.9 m is the shortest at 0.3 m from the corners
}

TEST(TangentBug, PassesADoorOfNinetyCentimetres) {
  BoxWorld world;
  world.addFrame(10, 10);
  world.add(0, 4.9, 4.0, 5.1);
  world.add(4.9, 4.9, 10, 5.1);
  const TangentRun end = run(world, {8, 2, 0}, {2, 8});
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_GE(end.clearance, 0.25);
  EXPECT_LT(end.distance, 8.7);
}

TEST(TangentBug, IsAtItsGoalAtOnceWhereItStandsThere) {
  TangentBug bug{RobotParameters{}};
  bug.setGoal({1, 1});
  const Velocity velocity = bug.step(BoxWorld{}.scan({1, 1, 0}, 8), {1, 1, 0}, {}, 0.0);
  EXPECT_EQ(bug.state(), TangentBugState::kReached);
  EXPECT_EQ(velocity.linear, 0.0);
  EXPECT_EQ(velocity.angular, 0.0);
}

TEST(TangentBug, WithoutAGoalStands) {
  TangentBug bug{RobotParameters{}};
  const Velocity velocity = bug.step(BoxWorld{}.scan({}, 8), {}, {}, 0.0);
  EXPECT_EQ(velocity.linear, 0.0);
  EXPECT_EQ(velocity.angular, 0.0);
}

TEST(TangentBug, ProvesAGoalInsideAnObstacleUnreachable) {
  BoxWorld world;
  world.addFrame(8, 8);
  world.add(3, 3, 5, 5);
  const TangentRun end = run(world, {1, 1, 0}, {4, 4});
  EXPECT_EQ(end.state, TangentBugState::kUnreachable);
  EXPECT_LT(end.distance, 25.0);  // once around the box is 10 m
}

TEST(TangentBug, ProvesAGoalTooCloseToAWallUnreachable) {
  BoxWorld world;
  world.addFrame(6, 6);
  const TangentRun end = run(world, {1, 1, 0}, {5.95, 3});
  EXPECT_EQ(end.state, TangentBugState::kUnreachable);
}

TEST(TangentBug, ProvesAGoalInTheNextRoomUnreachableWhereTheDoorIsTooNarrow) {
  BoxWorld world;
  world.addFrame(8, 4);
  world.add(3.9, 0, 4.1, 1.8);
  world.add(3.9, 2.25, 4.1, 4);
  const TangentRun end = run(world, {1, 1, 0}, {7, 2});
  EXPECT_EQ(end.state, TangentBugState::kUnreachable);
  EXPECT_GE(end.clearance, 0.25);
}

TEST(TangentBug, LeavesAWallThatItTouchesAtTheStart) {
  BoxWorld world;
  world.addFrame(6, 6);
  for (double heading : {0.0, M_PI, 0.5 * M_PI}) {
    const TangentRun end = run(world, {0.25, 3, heading}, {4, 3});
    EXPECT_EQ(end.state, TangentBugState::kReached);
    EXPECT_GE(end.clearance, 0.25 - 1e-9);
  }
}

TEST(TangentBug, StopsWhereTheScanIsEmptyOrInvalid) {
  std::vector<Scan> blind(3);
  blind[1] = BoxWorld{}.scan({}, 8);
  for (double& range : blind[1].ranges) range = std::nan("");
  blind[2] = blind[1];
  for (double& range : blind[2].ranges) range = 0.0;
  for (const Scan& scan : blind) {
    TangentBug bug{RobotParameters{}};
    bug.setGoal({5, 0});
    Velocity velocity{0.7, 0.5};
    Pose2 pose;
    for (int i = 0; i < 10; ++i) {
      const Velocity command = bug.step(scan, pose, velocity, kPeriod * i);
      drive(command, RobotParameters{}, kPeriod, pose, velocity);
    }
    EXPECT_EQ(velocity.linear, 0.0);
    EXPECT_EQ(velocity.angular, 0.0);
    EXPECT_EQ(bug.state(), TangentBugState::kMotionToGoal);
  }
}

TEST(TangentBug, GoesOnAfterABlindMoment) {
  BoxWorld world;
  world.addFrame(8, 4);
  TangentBug bug{RobotParameters{}};
  bug.setGoal({7, 2});
  Pose2 pose{1, 2, 0};
  Velocity velocity;
  for (int i = 0; i < 300 && bug.state() != TangentBugState::kReached; ++i) {
    Scan scan = world.scan(pose, 8);
    if (i / 10 % 3 == 1) scan.ranges.assign(scan.size(), std::nan(""));
    drive(bug.step(scan, pose, velocity, kPeriod * i), RobotParameters{}, kPeriod, pose, velocity);
  }
  EXPECT_EQ(bug.state(), TangentBugState::kReached);
}

TEST(TangentBug, DoesNotDriveWhereNoBeamLooks) {
  BoxWorld world;
  world.addFrame(10, 10);
  TangentBug bug{RobotParameters{}};
  bug.setGoal({8, 5});
  Scan scan = world.scan({2, 5, 0}, 8);
  for (std::size_t i = 120; i < 240; ++i) scan.ranges[i] = std::nan("");  // 60 degrees each way
  EXPECT_EQ(bug.step(scan, {2, 5, 0}, {}, 0.0).linear, 0.0);
}

TEST(TangentBug, TakesScansOfVeryFewBeams) {
  for (std::size_t beams = 0; beams <= 3; ++beams) {
    Scan scan;
    scan.angle_min = -0.1;
    scan.angle_increment = 0.1;
    scan.free_range_without_return = 8.0;
    scan.ranges.assign(beams, 2.0);
    TangentBug bug{RobotParameters{}};
    bug.setGoal({1, 0});
    const Velocity velocity = bug.step(scan, {}, {}, 0.0);
    EXPECT_TRUE(std::isfinite(velocity.linear) && std::isfinite(velocity.angular));
  }
}

TEST(TangentBug, ANewGoalStartsAnew) {
  BoxWorld world;
  world.addFrame(8, 8);
  world.add(3, 3, 5, 5);
  TangentBug bug{RobotParameters{}};
  Pose2 pose{1, 4, 0};
  Velocity velocity;
  bug.setGoal({4, 4});
  for (int i = 0; i < 150; ++i) {
    drive(bug.step(world.scan(pose, 8), pose, velocity, kPeriod * i), RobotParameters{}, kPeriod,
          pose, velocity);
  }
  bug.setGoal({7, 7});
  EXPECT_EQ(bug.state(), TangentBugState::kMotionToGoal);
  for (int i = 150; i < 600 && bug.state() != TangentBugState::kReached; ++i) {
    drive(bug.step(world.scan(pose, 8), pose, velocity, kPeriod * i), RobotParameters{}, kPeriod,
          pose, velocity);
  }
  EXPECT_EQ(bug.state(), TangentBugState::kReached);
}

TEST(TangentBug, AClearRayToTheGoalMakesTheReachDistanceZero) {
  BoxWorld world;
  world.addFrame(8, 8);
  TangentBug bug{RobotParameters{}};
  bug.setGoal({5, 4});
  bug.step(world.scan({2, 4, 0}, 8), {2, 4, 0}, {}, 0.0);
  EXPECT_NEAR(bug.reachDistance(), 0.0, 1e-9);
}

TEST(TangentBug, TheReachDistanceCountsFreePlacesNotOnlyHits) {
  // No return at all: the place in sight nearest to the goal lies at the laser's range.
  TangentBug bug{RobotParameters{}};
  bug.setGoal({10, 0});
  bug.step(BoxWorld{}.scan({0, 0, 0}, 4), {0, 0, 0}, {}, 0.0);
  EXPECT_NEAR(bug.reachDistance(), 6.0, 1e-9);
}

TEST(TangentBug, IsDeterministic) {
  const Trap trap = concavePocket();
  RunOptions options;
  options.noise = 0.02;
  const TangentRun a = run(trap.world, trap.start, trap.goal, options);
  const TangentRun b = run(trap.world, trap.start, trap.goal, options);
  ASSERT_EQ(a.path.size(), b.path.size());
  EXPECT_TRUE(std::equal(a.path.begin(), a.path.end(), b.path.begin()));
}

TEST(TangentBug, BringsANoisyLaserOfFiveCentimetresThroughADoor) {
  BoxWorld world;
  world.addFrame(10, 10);
  world.add(0, 4.9, 4.0, 5.1);
  world.add(4.9, 4.9, 10, 5.1);
  RunOptions options;
  options.noise = 0.05;
  const TangentRun end = run(world, {8, 2, 0}, {2, 8}, options);
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_GE(end.clearance, 0.25);
}

TEST(TangentBug, FindsItsWayWithALaserOf180Degrees) {
  const Trap trap = concavePocket();
  RunOptions options;
  options.field_of_view = M_PI;
  options.beams = 181;
  const TangentRun end = run(trap.world, trap.start, trap.goal, options);
  EXPECT_EQ(end.state, TangentBugState::kReached);
  EXPECT_GE(end.clearance, 0.25);
  EXPECT_LT(end.duration, 30.0);  // the way out of the pocket and around it is 20 s
}

// The cells of the map, or a pose that has drifted, put an obstacle nearly where the robot stands,
// beside its field of view. It drives along it, and away.
TEST(TangentBug, IsNotHeldByWhatItKnowsTooNear) {
  for (const double bearing : {-1.5, -1.3, -1.1, 1.1, 1.3, 1.5}) {
    TangentBug bug{RobotParameters{}};
    bug.setGoal({3, 0});
    Pose2 pose;
    Velocity velocity;
    const Eigen::Vector2d known(0.24 * std::cos(bearing), 0.24 * std::sin(bearing));
    for (int i = 0; i < 200 && bug.state() != TangentBugState::kReached; ++i) {
      const Scan scan = BoxWorld{}.scan(pose, 8.0, 121, 2.0 / 3.0 * M_PI);
      const TangentBug::Surroundings around{scan, pose, kFinestSigma, {known}};
      drive(bug.step(around, velocity, kPeriod * i), RobotParameters{}, kPeriod, pose, velocity);
      EXPECT_GE((pose.position() - known).norm(), 0.24 - 1e-3);
    }
    EXPECT_EQ(bug.state(), TangentBugState::kReached) << bearing;
  }
}

TEST(TangentBug, IsPromisedNoPlaceBehindItsBack) {
  TangentBug bug{RobotParameters{}};
  bug.setGoal({-5, 0});
  bug.step(BoxWorld{}.scan({}, 8.0, 181, M_PI), {}, {}, 0.0);
  EXPECT_EQ(bug.reachDistance(), 5.0);
  bug.step(BoxWorld{}.scan({0, 0, M_PI}, 8.0, 181, M_PI), {0, 0, M_PI}, {}, 0.1);
  EXPECT_EQ(bug.reachDistance(), 0.0);
}

}  // namespace
}  // namespace cca::testing
