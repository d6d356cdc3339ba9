// SPDX-License-Identifier: BSD-3-Clause
#include "motion/commanded_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <random>

#include "../navigation/box_world.hpp"

namespace cca::testing::commanded_motion_test {
namespace {

constexpr double kPeriod = 0.1;

/// Follows each command `latency` later, with accelerations of its own.
struct Base {
  RobotParameters robot;
  Pose2 pose = {};
  Velocity velocity = {};
  double time = 0.0;
  std::deque<std::pair<double, Velocity>> told = {};
  Velocity heard = {};

  void obey(const Velocity& command) {
    told.push_back({time, command});
    for (int i = 0; i < 20; ++i) {
      while (!told.empty() && told.front().first + robot.latency < time + 0.0026) {
        heard = told.front().second;
        told.pop_front();
      }
      drive(heard, robot, 0.005, pose, velocity);
      time += 0.005;
    }
  }
};

RobotParameters withLatency(double latency) {
  RobotParameters robot;
  robot.latency = latency;
  return robot;
}

/// Drives as at random, each command for a while. noise: of the odometry, as often as usual.
void driveAbout(Base& base, CommandedMotion& motion, int periods, double noise = 0.0) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  Velocity command;
  for (int i = 0; i < periods; ++i) {
    motion.observe({base.velocity.linear + 0.02 * noise * normal(random),
                    base.velocity.angular + 0.05 * noise * normal(random)},
                   base.time);
    if (i % 7 == 0) command = {0.35 + 0.35 * uniform(random), 1.5 * uniform(random)};
    motion.note(command);
    base.obey(command);
  }
}

TEST(CommandedMotion, OfARobotThatObeysAtOnceBeginsHereAndNow) {
  CommandedMotion motion(withLatency(0.0));
  motion.observe({0.4, 0.3}, 1.0);
  const PredictedState state = motion.expected();
  EXPECT_EQ(state.T_now_then.x, 0.0);
  EXPECT_EQ(state.T_now_then.theta, 0.0);
  EXPECT_EQ(state.velocity.linear, 0.4);
  EXPECT_EQ(state.velocity.angular, 0.3);
  EXPECT_EQ(state.delay, 0.0);
}

TEST(CommandedMotion, FollowsTheCommandsUnderWay) {
  for (const double latency : {0.1, 0.15, 0.3}) {
    Base base{withLatency(latency)};
    CommandedMotion motion(base.robot);
    driveAbout(base, motion, 40);
    motion.observe(base.velocity, base.time);
    const PredictedState state = motion.expected();
    Base then = base;
    const int steps = static_cast<int>(std::lround(latency / 0.005));
    for (int i = 0; i < steps; ++i) {
      while (!then.told.empty() && then.told.front().first + latency < then.time + 0.0026) {
        then.heard = then.told.front().second;
        then.told.pop_front();
      }
      drive(then.heard, then.robot, 0.005, then.pose, then.velocity);
      then.time += 0.005;
    }
    const Pose2 moved = base.pose.inverse() * then.pose;
    EXPECT_GT(moved.position().norm(), 0.01) << latency;
    EXPECT_NEAR((moved.position() - state.T_now_then.position()).norm(), 0.0, 0.002) << latency;
    EXPECT_NEAR(moved.theta, state.T_now_then.theta, 0.01) << latency;
    EXPECT_NEAR(then.velocity.linear, state.velocity.linear, 0.01) << latency;
    EXPECT_NEAR(then.velocity.angular, state.velocity.angular, 0.04) << latency;
  }
}

TEST(CommandedMotion, AtFirstReckonsWithAnyLatencyAroundTheOneTold) {
  CommandedMotion motion(withLatency(0.2));
  motion.observe({}, 0.0);
  const auto others = motion.latencyHypotheses();
  ASSERT_EQ(others.size(), 2u);
  EXPECT_NEAR(others[0].delay, 0.05, 1e-9);
  EXPECT_NEAR(others[1].delay, 0.35, 1e-9);
}

TEST(CommandedMotion, LearnsHowLateCommandsAre) {
  for (const double noise : {0.0, 0.5, 1.0}) {
    for (const double latency : {0.0, 0.1, 0.15, 0.2, 0.3, 0.4}) {
      Base base{withLatency(latency)};
      CommandedMotion motion(withLatency(0.15));
      driveAbout(base, motion, 150, noise);
      EXPECT_NEAR(motion.actuation().latency(), latency, 0.026) << noise;
      EXPECT_LE(motion.actuation().earliest(), latency + 1e-9) << noise;
      EXPECT_GE(motion.actuation().latest(), latency - 1e-9) << noise;
      EXPECT_TRUE(motion.actuation().knowsLatency()) << noise << " " << latency;
      EXPECT_NEAR(motion.latency(), std::max(latency, 0.15), 0.026);
    }
  }
}

TEST(CommandedMotion, OfARobotAsToldHasNothingElseToReckonWith) {
  for (const double latency : {0.0, 0.15, 0.3}) {
    Base base{withLatency(latency)};
    CommandedMotion motion(base.robot);
    driveAbout(base, motion, 60);
    EXPECT_TRUE(motion.latencyHypotheses().empty()) << latency;
    EXPECT_EQ(motion.believed().max_linear_acceleration, base.robot.max_linear_acceleration);
  }
}

TEST(CommandedMotion, LearnsHowHardTheRobotBrakes) {
  for (const double share : {1.0, 0.7, 0.5, 0.3}) {
    Base base{withLatency(0.15)};
    CommandedMotion motion(base.robot);
    EXPECT_EQ(motion.actuation().reliableBrakes().linear, 0.5);
    base.robot.max_linear_acceleration = share;
    driveAbout(base, motion, 150);
    EXPECT_NEAR(motion.actuation().brakes().linear, share, 0.01);
    EXPECT_NEAR(motion.actuation().reliableBrakes().linear, std::min(share, 0.5), 0.01);
    EXPECT_NEAR(motion.actuation().latency(), 0.15, 0.026);
  }
}

// Its motors are off, or somebody holds it: that is no latency.
TEST(CommandedMotion, LearnsNothingWhereTheBaseDoesNotRespond) {
  CommandedMotion motion(withLatency(0.15));
  for (int i = 0; i < 300; ++i) {
    motion.observe({}, kPeriod * i);
    motion.note({i / 20 % 2 ? 0.3 : 0.0, i / 10 % 2 ? 0.8 : 0.0});
  }
  EXPECT_NEAR(motion.latency(), 0.15, 1e-9);
  EXPECT_EQ(motion.actuation().brakes().linear, 1.0);
}

TEST(CommandedMotion, BearsTimesAndVelocitiesThatCannotBe) {
  CommandedMotion motion(withLatency(0.15));
  const double nan = std::nan("");
  for (int i = 0; i < 50; ++i) {
    motion.observe({i % 3 ? 0.1 * i : nan, nan}, i % 5 ? kPeriod * i : -kPeriod * i);
    motion.note({0.3, i % 4 ? 0.1 : nan});
  }
  EXPECT_TRUE(std::isfinite(motion.latency()));
  EXPECT_GT(motion.actuation().reliableBrakes().linear, 0.0);
}

TEST(CommandedMotion, PassesOverWhatNoSuchRobotCanDo) {
  CommandedMotion motion(withLatency(0.15));
  motion.observe({0.3, 0.1}, 0.0);
  const double nan = std::nan("");
  for (const Velocity broken : {Velocity{5.0, 0.0}, Velocity{0.0, 50.0}, Velocity{nan, 0.0}}) {
    motion.observe(broken, 0.1);
    EXPECT_EQ(motion.expected().velocity.linear, 0.3);
  }
}

TEST(SentCommands, KnowNothingBeforeTheFirstAndAfterAGap) {
  SentCommands sent;
  EXPECT_FALSE(sent.at(1.0));
  sent.add({0.1, 0.0}, 1.0);
  sent.add({0.2, 0.0}, 1.1);
  sent.add({0.3, 0.0}, 1.1);
  EXPECT_FALSE(sent.at(0.9));
  EXPECT_EQ(sent.at(1.05)->linear, 0.1);
  EXPECT_EQ(sent.at(1.1)->linear, 0.3);
  sent.add({0.4, 0.0}, 3.0);
  EXPECT_FALSE(sent.at(2.9));
  EXPECT_EQ(sent.at(3.5)->linear, 0.4);
}

TEST(CommandedMotion, ACommandStandsForTheLongestTimeBetweenObservationsOfLate) {
  CommandedMotion motion{RobotParameters{}};
  EXPECT_DOUBLE_EQ(motion.period(), 0.1);  // until it is known
  double time = 0.0;
  const auto observe = [&](int times, double interval) {
    for (int i = 0; i < times; ++i) motion.observe({}, time += interval);
  };
  observe(5, 0.02);
  EXPECT_DOUBLE_EQ(motion.period(), 0.1);
  observe(1, 0.2);
  EXPECT_NEAR(motion.period(), 0.2, 1e-5);
  observe(5, 0.1);
  EXPECT_DOUBLE_EQ(motion.period(), 0.1);
  observe(1, 60.0);  // a pause
  EXPECT_DOUBLE_EQ(motion.period(), 1.0);
}

}  // namespace
}  // namespace cca::testing::commanded_motion_test
