// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/velocity_controller.hpp"

#include <gtest/gtest.h>

#include "box_world.hpp"

namespace cca::testing::velocity_controller_test {
namespace {

constexpr double kPeriod = 0.1;
const RobotParameters kRobot;
const double kClearance = kRobot.leastClearance(), kHeeded = kClearance + 0.15;
const ControlTarget kAhead{{3.0, 0.0}, true};

LocalView viewOf(const BoxWorld& world, const Pose2& pose, double range_sigma = 0.0) {
  LocalView view = makeLocalView(world.scan(pose, 8.0), {}, pose, 2.0 * kClearance);
  view.range_sigma = range_sigma;
  return view;
}

TEST(VelocityController, WithoutATargetBrakes) {
  VelocityController driver(kRobot);
  const Velocity velocity =
      driver.step({}, {0.5, 1.0}, viewOf({}, {}), {}, kClearance, kHeeded, 0.0);
  EXPECT_LT(velocity.linear, 0.5);
  EXPECT_LT(velocity.angular, 1.0);
}

TEST(VelocityController, DrivesToItsTargetAndStopsThere) {
  VelocityController driver(kRobot);
  Pose2 pose;
  Velocity velocity;
  for (int i = 0; i < 150; ++i) {
    const LocalView view = viewOf({}, pose);
    drive(driver.step(kAhead, velocity, view, {}, kClearance, kHeeded, kPeriod * i), kRobot,
          kPeriod, pose, velocity);
  }
  EXPECT_LT((pose.position() - kAhead.p_map).norm(), 0.05);
  EXPECT_LT(velocity.linear, 0.05);
}

// A post ahead that the next scan does not show.
TEST(VelocityController, HeedsForAMomentWhatNoisyScansHaveShown) {
  BoxWorld post;
  post.add(kClearance + 0.002, -0.02, kClearance + 0.04, 0.02);
  const auto speedAfter = [&](double sigma, int scans) {
    VelocityController driver(kRobot);
    Velocity command;
    for (int i = 0; i <= scans; ++i) {
      const LocalView view = viewOf(i == 0 ? post : BoxWorld{}, {}, sigma);
      command = driver.step(kAhead, {}, view, {}, kClearance, kHeeded, kPeriod * i);
    }
    return command.linear;
  };
  EXPECT_GT(speedAfter(0.0, 1), 0.09);
  EXPECT_LT(speedAfter(0.01, 1), 0.02);
  EXPECT_LT(speedAfter(0.01, 4), 0.02);
  EXPECT_GT(speedAfter(0.01, 6), 0.09);
}

// One return beside the way, nearer than the least clearance.
TEST(VelocityController, PassesACornerMoreNarrowlyWhereCommandsActAtOnce) {
  const Eigen::Vector2d corner{0.4, kClearance - 0.008};
  const auto nearestBy = [&](double latency) {
    RobotParameters robot = kRobot;
    robot.latency = latency;
    VelocityController driver(robot);
    Pose2 pose;
    Velocity velocity;
    double nearest = corner.norm();
    for (int i = 0; i < 40; ++i) {
      LocalView view = viewOf({}, pose);
      view.returns.push_back(corner);
      drive(driver.step(kAhead, velocity, view, {}, kClearance, kHeeded, kPeriod * i), robot,
            kPeriod, pose, velocity);
      nearest = std::min(nearest, (corner - pose.position()).norm());
    }
    return nearest;
  };
  EXPECT_LT(nearestBy(0.0), kClearance - 0.004);
  EXPECT_GT(nearestBy(0.15), kClearance - 0.001);
}

// Inside the clearance of what stands ahead to the right, driving straight on is not safe.
TEST(VelocityController, GetsAwayFromWhatHoldsIt) {
  const Eigen::Vector2d post(0.1, -0.23);
  VelocityController driver(kRobot);
  Pose2 pose;
  Velocity velocity;
  double stood = 0.0;
  for (int i = 0; i < 100; ++i) {
    LocalView view = viewOf({}, pose);
    view.obstacles.push_back(post);
    view.ends_here.push_back(true);
    drive(driver.step(kAhead, velocity, view, {}, kClearance, kHeeded, kPeriod * i), kRobot,
          kPeriod, pose, velocity);
    EXPECT_GE((pose.position() - post).norm(), post.norm() - 1e-3);
    if (pose.position().norm() < 0.01) stood += kPeriod;
  }
  EXPECT_GT(pose.x, 1.0);
  EXPECT_LT(stood, 3.0);
}

}  // namespace
}  // namespace cca::testing::velocity_controller_test
