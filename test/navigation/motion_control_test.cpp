// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/motion_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "box_world.hpp"

namespace cca::testing::motion_control_test {
namespace {

const RobotParameters kRobot;

TEST(MotionControl, DrivesStraightAtFullSpeedToAFarTargetAhead) {
  const Velocity velocity = velocityTowards({10, 0}, true, kRobot);
  EXPECT_DOUBLE_EQ(velocity.linear, kRobot.max_linear_velocity);
  EXPECT_DOUBLE_EQ(velocity.angular, 0.0);
}

TEST(MotionControl, TurnsOnTheSpotTowardsATargetBeside) {
  EXPECT_DOUBLE_EQ(velocityTowards({0, 1}, true, kRobot).linear, 0.0);
  EXPECT_GT(velocityTowards({0, 1}, true, kRobot).angular, 0.0);
  EXPECT_LT(velocityTowards({0, -1}, true, kRobot).angular, 0.0);
}

TEST(MotionControl, BrakesForATargetToStopAtAndNotForOneToPass) {
  EXPECT_LT(velocityTowards({0.1, 0}, true, kRobot).linear, 0.4);
  EXPECT_DOUBLE_EQ(velocityTowards({0.1, 0}, false, kRobot).linear, kRobot.max_linear_velocity);
}

TEST(MotionControl, StaysWithinTheLimitsForEveryTarget) {
  for (double x = -3; x <= 3; x += 0.1) {
    for (double y = -3; y <= 3; y += 0.1) {
      const Velocity velocity = velocityTowards({x, y}, true, kRobot);
      EXPECT_TRUE(std::isfinite(velocity.linear) && std::isfinite(velocity.angular));
      EXPECT_GE(velocity.linear, 0.0);
      EXPECT_LE(velocity.linear, kRobot.max_linear_velocity);
      EXPECT_LE(std::abs(velocity.angular), kRobot.max_angular_velocity);
    }
  }
}

constexpr double kPeriod = 0.1, kRadius = 0.27;
const Velocity kBrakes{kRobot.max_linear_acceleration, kRobot.max_angular_acceleration};

std::vector<Hazard> seenFrom(const Pose2& pose, const std::vector<Eigen::Vector2d>& points) {
  std::vector<Hazard> hazards;
  for (const auto& p : points) hazards.push_back({pose.inverse() * p, 0.0});
  return hazards;
}

TEST(SafeVelocity, WithoutHazardsGivesWhatIsWantedWithinTheAccelerations) {
  const Velocity velocity = safeVelocity({0.7, 1.5}, {0, 0}, {}, kRobot, kRadius, kPeriod, kBrakes);
  EXPECT_NEAR(velocity.linear, kRobot.max_linear_acceleration * kPeriod, 1e-12);
  EXPECT_NEAR(velocity.angular, kRobot.max_angular_acceleration * kPeriod, 1e-12);
}

// Whatever is wanted, at random, among random points: the robot never touches one.
TEST(SafeVelocity, NoWishLeadsIntoAPoint) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int world = 0; world < 30; ++world) {
    std::vector<Eigen::Vector2d> points;
    while (points.size() < 60) {
      const Eigen::Vector2d p(4.0 * uniform(generator), 4.0 * uniform(generator));
      if (p.norm() > 0.3) points.push_back(p);
    }
    Pose2 pose;
    Velocity velocity, wanted;
    for (int i = 0; i < 300; ++i) {
      if (i % 10 == 0) wanted = {std::abs(uniform(generator)), 1.5 * uniform(generator)};
      const Velocity command =
          safeVelocity(wanted, velocity, seenFrom(pose, points), kRobot, kRadius, kPeriod, kBrakes);
      drive(command, kRobot, kPeriod, pose, velocity);
      for (const auto& p : points) ASSERT_GE((p - pose.position()).norm(), kRadius - 0.003);
    }
  }
}

TEST(SafeVelocity, StopsBeforeAWallAtFullSpeed) {
  std::vector<Eigen::Vector2d> wall;
  for (double y = -2; y <= 2; y += 0.05) wall.push_back({2.0, y});
  Pose2 pose;
  Velocity velocity;
  for (int i = 0; i < 100; ++i) {
    const Velocity command =
        safeVelocity({0.7, 0.0}, velocity, seenFrom(pose, wall), kRobot, kRadius, kPeriod, kBrakes);
    drive(command, kRobot, kPeriod, pose, velocity);
  }
  EXPECT_LE(pose.x, 2.0 - kRadius + 1e-6);
  EXPECT_GT(pose.x, 2.0 - kRadius - 0.35) << "without giving the way away";
}

// By noise the robot may be slower than it reads: a fall of one period from there could be faster.
TEST(SafeVelocity, AsksForAStandstillWhereNothingElseIsSafe) {
  const std::vector<Hazard> wall{{{0.35, 0.0}, 0.0}};
  EXPECT_EQ(safeVelocity({0.7, 0.0}, {0.6, 0.0}, wall, kRobot, kRadius, kPeriod, kBrakes).linear,
            0.0);
}

// Until a late command acts, somebody comes nearer by what its latency takes.
TEST(SafeVelocity, OfALateRobotHeedsWhoIsStillFarOff) {
  const Hazard walker{{0.6, 0.0}, 1.0, -0.3};
  EXPECT_EQ(safeVelocity({0.7, 0.0}, {0, 0}, {walker}, kRobot, kRadius, kPeriod, kBrakes).linear,
            0.0);
}

TEST(SafeVelocity, StaysWithinTheLimitsWhateverIsMeasured) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const Velocity measured :
       {Velocity{10.0, 50.0}, Velocity{-10.0, -50.0}, Velocity{inf, -inf}}) {
    const Velocity command =
        safeVelocity({0.3, 0.0}, measured, {}, kRobot, kRadius, kPeriod, kBrakes);
    EXPECT_LE(std::abs(command.linear), kRobot.max_linear_velocity);
    EXPECT_LE(std::abs(command.angular), kRobot.max_angular_velocity);
  }
}

// Somebody who pushes against the standing robot: not even slowly may it go nearer.
TEST(SafeVelocity, WhatTouchesTheRobotComesNoNearer) {
  for (double bearing = 0.0; bearing <= M_PI; bearing += 0.1) {
    const Eigen::Vector2d p(0.249 * std::cos(bearing), 0.249 * std::sin(bearing));
    for (const double wanted : {0.7, 0.1, 0.01, 0.001}) {
      const Velocity velocity =
          safeVelocity({wanted, 0.0}, {0, 0}, {{p, 0.0}}, kRobot, kRadius, kPeriod, kBrakes);
      if (bearing < 0.5 * M_PI) {
        EXPECT_DOUBLE_EQ(velocity.linear, 0.0) << bearing;
      }
      if (bearing > 0.5 * M_PI) {
        EXPECT_GT(velocity.linear, 0.0) << bearing;
      }
    }
  }
}

TEST(SafeVelocity, TurningOnTheSpotIsSafeInContact) {
  const Velocity velocity =
      safeVelocity({0.0, 1.5}, {0, 0}, {{{0.25, 0.0}, 0.0}}, kRobot, kRadius, kPeriod, kBrakes);
  EXPECT_GT(velocity.angular, 0.0);
  EXPECT_DOUBLE_EQ(velocity.linear, 0.0);
}

TEST(SafeVelocity, LeavesAContactButDoesNotDeepenIt) {
  const auto ahead = std::vector<Hazard>{{{0.25, 0.0}, 0.0}};
  const auto behind = std::vector<Hazard>{{{-0.25, 0.0}, 0.0}};
  EXPECT_DOUBLE_EQ(safeVelocity({0.5, 0}, {0, 0}, ahead, kRobot, kRadius, kPeriod, kBrakes).linear,
                   0.0);
  EXPECT_GT(safeVelocity({0.5, 0}, {0, 0}, behind, kRobot, kRadius, kPeriod, kBrakes).linear, 0.0);
}

TEST(SafeVelocity, AHazardWithAnAllowanceMayComeNearerByIt) {
  const std::vector<Hazard> strict{{{kRadius + 0.001, 0.0}}};
  const std::vector<Hazard> lenient{{{kRadius + 0.001, 0.0}, 0.0, 0.1}};
  const auto speed = [&](const std::vector<Hazard>& hazards) {
    return safeVelocity({0.1, 0.0}, {0, 0}, hazards, kRobot, kRadius, kPeriod, kBrakes).linear;
  };
  EXPECT_LT(speed(strict), 0.02);
  EXPECT_GT(speed(lenient), 0.02);
}

TEST(SafeVelocity, BrakesForSomebodyWhoComesNearerAndNotForAWallAsFarAway) {
  const Velocity present{0.7, 0.0};
  const std::vector<Hazard> wall{{{1.2, 0.0}, 0.0}}, walker{{{1.2, 0.0}, 1.0}};
  EXPECT_DOUBLE_EQ(safeVelocity(present, present, wall, kRobot, kRadius, kPeriod, kBrakes).linear,
                   0.7);
  EXPECT_LT(safeVelocity(present, present, walker, kRobot, kRadius, kPeriod, kBrakes).linear, 0.7);
}

TEST(SafeVelocity, StandsStillForSomebodyWhoTouchesIt) {
  const Velocity velocity =
      safeVelocity({0.7, 1.0}, {0, 0}, {{{0.26, 0.1}, 1.0}}, kRobot, kRadius, kPeriod, kBrakes);
  EXPECT_DOUBLE_EQ(velocity.linear, 0.0);
  EXPECT_DOUBLE_EQ(velocity.angular, 0.0);
}

Hazard hazardAt(double bearing, double distance) {
  return {{distance * std::cos(bearing), distance * std::sin(bearing)}};
}

TEST(BearingPast, IsTheWantedOneWhereNothingIsTooNearInThatDirection) {
  EXPECT_EQ(bearingPast({}, kRadius, 0.3), 0.3);
  EXPECT_EQ(bearingPast({hazardAt(0.3, kRadius + 0.001)}, kRadius, 0.3), 0.3);
  EXPECT_EQ(bearingPast({hazardAt(0.3 + 1.6, kRadius - 0.03)}, kRadius, 0.3), 0.3);
  Hazard lenient = hazardAt(0.3, kRadius - 0.01);
  lenient.allowance = 0.02;
  EXPECT_EQ(bearingPast({lenient}, kRadius, 0.3), 0.3);
}

// From any place beside some hazards, and whatever is wanted: where there is a direction that comes
// nearer to none, the robot gets away in it, and it is the nearest one.
TEST(BearingPast, LeadsAwayFromWhatIsTooNear) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> bearing(-M_PI, M_PI), distance(0.2, kRadius);
  int turned = 0;
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<Hazard> hazards;
    for (int i = 0; i < 1 + trial % 3; ++i)
      hazards.push_back(hazardAt(bearing(generator), distance(generator)));
    // cos of the angle to the hazard that is most nearly in that direction
    const auto towards = [&](double direction) {
      double most = -1.0;
      for (const Hazard& hazard : hazards) {
        const Eigen::Vector2d ahead(std::cos(direction), std::sin(direction));
        most = std::max(most, hazard.p_robot.normalized().dot(ahead));
      }
      return most;
    };
    const double wanted = bearing(generator);
    const double past = bearingPast(hazards, kRadius, wanted);
    for (double off = 0.0; off < M_PI; off += 0.005) {
      if (towards(wanted + off) > -0.03 && towards(wanted - off) > -0.03) continue;
      EXPECT_LT(towards(past), 0.0);
      EXPECT_LE(std::abs(std::remainder(past - wanted, 2.0 * M_PI)), off);
      turned += past != wanted;
      break;
    }
  }
  EXPECT_GT(turned, 100);
}

}  // namespace
}  // namespace cca::testing::motion_control_test
