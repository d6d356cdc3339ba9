// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/motion_control.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
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

}  // namespace
}  // namespace cca
