// SPDX-License-Identifier: BSD-3-Clause
#include "ros/driving/mount_error.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cca {
namespace {

struct Driven {
  std::vector<Pose2> by_scans, by_wheels;
};

/// A robot that drives arcs, whose laser hangs otherwise than told; scans err by 2 mm, wheels count
/// `scale` of the way.
Driven driveWith(const Pose2& T_true_told, double scale, double turning = 0.6) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.002);
  Driven driven;
  Pose2 robot, wheels;
  for (int k = 0; k < 200; ++k) {
    const double turn = 0.1 * turning * (k % 50 < 25 ? 1.0 : -0.7);
    const Pose2 step{0.03, 0.0, turn};
    robot = robot * step;
    wheels = wheels * Pose2{scale * step.x, 0.0, turn};
    Pose2 seen = robot * T_true_told;
    seen.x += noise(random);
    seen.y += noise(random);
    driven.by_scans.push_back(seen);
    driven.by_wheels.push_back(wheels);
  }
  return driven;
}

TEST(MountError, IsFoundWhereTheLaserIsOffAndTurned) {
  for (const Pose2& off : {Pose2{0.1, -0.05, 0.1}, Pose2{-0.2, 0.0, 0.0},
                           Pose2{0.0, 0.0, M_PI - 0.1}, Pose2{0.0, 0.0, 0.0}}) {
    const Driven driven = driveWith(off, 1.1);
    const auto found = mountError(driven.by_scans, driven.by_wheels);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->T_true_told.x, off.x, 0.015);
    EXPECT_NEAR(found->T_true_told.y, off.y, 0.015);
    EXPECT_NEAR(wrapAngle(found->T_true_told.theta - off.theta), 0.0, 0.02);
    EXPECT_LT(found->sigma, 0.02);
    EXPECT_LT(found->turn_sigma, 0.02);
  }
}

TEST(MountError, OfARobotThatHardlyTurnsThePositionIsNotKnown) {
  const Driven driven = driveWith({0.1, 0.0, 0.1}, 1.0, 0.01);
  const auto found = mountError(driven.by_scans, driven.by_wheels);
  ASSERT_TRUE(found);
  EXPECT_GT(found->sigma, 0.02);
  EXPECT_NEAR(found->T_true_told.theta, 0.1, 0.02);
}

TEST(MountError, OfARobotThatStandsNothingIsKnown) {
  EXPECT_FALSE(mountError(std::vector<Pose2>(100), std::vector<Pose2>(100)));
}

}  // namespace
}  // namespace cca
