// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/motion_compensation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "swept_room.hpp"

namespace cca::motion_compensation_test {
namespace {

const Laser kFullTurn{-M_PI, M_PI / 180.0, 360};
const Laser kWide{-0.75 * M_PI, 1.5 * M_PI / 720.0, 721};
const Pose2 kMount{0.15, -0.05, 0.4};

/// A robot that turns on the spot, one way and the other, with rests, as odometry of 2 % sees it.
struct Drive {
  Laser laser = kFullTurn;
  double sweep = 0.0;    ///< s, with its sign
  double period = 0.18;  ///< s
  double told = 0.0;     ///< s, what the driver says
  double rate = 1.2;     ///< rad/s
  double scale = 1.02;   ///< of the odometry's heading
  bool rests = true;
};

/// s, what the compensation takes the sweep for after this many scans.
double learned(const Drive& drive, int scans, MotionCompensation compensation = {}) {
  const SweptRoom room;
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, 0.01);
  double heading = 0.0, rate = 0.0;
  for (int k = 0; k < scans; ++k) {
    const double phase = std::fmod(k * drive.period, 12.0);
    const double wanted = !drive.rests                                  ? drive.rate
                          : phase < 1.0 || (phase > 6.0 && phase < 7.0) ? 0.0
                          : phase < 6.0                                 ? drive.rate
                                                                        : -drive.rate;
    const double before = rate;
    rate += std::clamp(wanted - rate, -2.0 * drive.period, 2.0 * drive.period);
    heading += 0.5 * (before + rate) * drive.period;
    const Twist robot{{0.0, 0.0}, rate};
    const Pose2 T_map_robot{0.5, -0.3, wrapAngle(heading)};
    Scan scan =
        room.sweep(drive.laser, T_map_robot * kMount, sensorTwist(robot, kMount), drive.sweep);
    for (double& range : scan.ranges) range += noise(generator);
    scan.sweep_duration = drive.told;
    const Pose2 T_odom_robot{0.5, -0.3, wrapAngle(drive.scale * heading)};
    compensation.undistort(scan, {SensorReading{T_odom_robot * kMount, k * drive.period}});
  }
  return compensation.sweepDuration();
}

TEST(MotionCompensation, BelievesADriverThatTellsItsSweep) {
  EXPECT_EQ(learned({kFullTurn, 0.17, 0.18, 0.17}, 3), 0.17);
}

TEST(MotionCompensation, FindsOutThatADriverHasTurnedItsArrayRound) {
  EXPECT_EQ(learned({kFullTurn, -0.17, 0.18, 0.17}, 120), -0.17);
}

TEST(MotionCompensation, FindsOutThatADriverTellsASweepThatIsNone) {
  EXPECT_EQ(learned({kFullTurn, 0.0, 0.18, 0.17}, 120), 0.0);
}

TEST(MotionCompensation, KeepsWhatIsRight) {
  EXPECT_EQ(learned({kFullTurn, 0.17, 0.18, 0.17}, 300), 0.17);
}

TEST(MotionCompensation, FindsASweepThatNobodyTells) {
  EXPECT_NEAR(learned({kFullTurn, 0.18, 0.18, 0.0}, 120), 0.18, 0.01);
  EXPECT_NEAR(learned({kFullTurn, -0.18, 0.18, 2e-6}, 120), -0.18, 0.01);
}

TEST(MotionCompensation, FindsTheSweepOfANarrowerLaser) {
  EXPECT_NEAR(learned({kWide, 0.075, 0.1, 0.0}, 240), 0.075, 0.005);
  EXPECT_NEAR(learned({kWide, -0.075, 0.1, 0.0}, 240), -0.075, 0.005);
}

TEST(MotionCompensation, LeavesScansOfOneInstantAlone) {
  for (const int scans : {20, 60, 120, 300}) {
    EXPECT_EQ(learned({kFullTurn, 0.0, 0.18, 0.0}, scans), 0.0);
    EXPECT_EQ(learned({kWide, 0.0, 0.1, 0.0}, scans), 0.0);
  }
}

TEST(MotionCompensation, FindsTheSweepOfARobotThatNeverRests) {
  EXPECT_NEAR(learned({kFullTurn, 0.18, 0.18, 0.0, 1.2, 1.02, false}, 120), 0.18, 0.01);
}

TEST(MotionCompensation, DoesNotTakeTheErrorOfWheelsForASweep) {
  for (const double scale : {0.95, 1.05}) {
    for (const int scans : {60, 120, 300}) {
      EXPECT_EQ(learned({kFullTurn, 0.0, 0.18, 0.0, 1.2, scale}, scans), 0.0) << scale;
      EXPECT_EQ(learned({kWide, 0.0, 0.1, 0.0, 1.2, scale}, scans), 0.0) << scale;
    }
  }
}

/// The same of a robot that never turns: from rest it drives 4 m straight on, as wheels of this
/// scale see it.
double learnedStraightOn(double sweep, double told, double scale) {
  const SweptRoom room;
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, 0.01);
  MotionCompensation compensation;
  constexpr double kPeriod = 0.18, kSpeed = 0.7, kAcceleration = 0.5, kWay = 4.0;
  double way = 0.0, speed = 0.0;
  for (int k = 0; way < kWay; ++k) {
    const double before = speed;
    if (k > 5) speed = std::min(kSpeed, speed + kAcceleration * kPeriod);
    way += 0.5 * (before + speed) * kPeriod;
    Scan scan = room.sweep(kFullTurn, Pose2{way - 2.0, 0.3, 0.1} * kMount,
                           sensorTwist({{speed, 0.0}, 0.0}, kMount), sweep);
    for (double& range : scan.ranges) range += noise(generator);
    scan.sweep_duration = told;
    const Pose2 T_odom_robot{scale * way, 0.0, 0.1};
    compensation.undistort(scan, {SensorReading{T_odom_robot * kMount, k * kPeriod}});
  }
  return compensation.sweepDuration();
}

TEST(MotionCompensation, FindsTheSweepOfARobotThatNeverTurns) {
  EXPECT_NEAR(learnedStraightOn(0.18, 0.0, 1.02), 0.18, 0.01);
  EXPECT_NEAR(learnedStraightOn(-0.18, 0.0, 1.02), -0.18, 0.01);
  EXPECT_NEAR(learnedStraightOn(-0.18, 0.18, 0.98), -0.18, 0.01);
}

TEST(MotionCompensation, DoesNotTakeWheelsThatCountWrongForASweep) {
  for (const double scale : {0.9, 0.95, 1.0, 1.05, 1.1}) {
    EXPECT_EQ(learnedStraightOn(0.0, 0.0, scale), 0.0) << scale;
  }
}

TEST(MotionCompensation, LearnsNothingWhereItIsTold) {
  EXPECT_EQ(learned({kFullTurn, 0.17, 0.18, 0.0}, 120, MotionCompensation(0.0)), 0.0);
  EXPECT_EQ(learned({kFullTurn, 0.0, 0.18, 0.0}, 120, MotionCompensation(-0.1)), -0.1);
}

TEST(MotionCompensation, ScansWithoutOdometryStayAsTheyAre) {
  const Scan scan = SweptRoom().sweep(kFullTurn, {}, {{0.0, 0.0}, 1.0}, 0.17);
  MotionCompensation compensation;
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(compensation.undistort(scan, {}).ranges, scan.ranges);
  }
}

/// m, the largest difference of a beam from the scan of one instant; the robot begins to turn at
/// 2 rad/s^2 after the first scan.
double errorWhileSpeedingUp(double around) {
  const SweptRoom room;
  MotionCompensation compensation(0.1);
  double largest = 0.0;
  const auto at = [](double k) {
    const double t = 0.1 * k;
    return SensorReading{{0.2, 0.1, t * t}, t};
  };
  for (int k = 0; k < 8; ++k) {
    const Pose2 T_map_sensor = at(k).T_odom_sensor;
    const Twist twist{{0.0, 0.0}, 0.2 * k};
    const Laser laser{-0.5 * M_PI, M_PI / 180.0, 181};
    SweepMotion motion{at(k)};
    if (around > 0.0) motion = {at(k), at(k - around), at(k + around)};
    const Scan still = compensation.undistort(room.sweep(laser, T_map_sensor, twist, 0.1), motion);
    const Scan truth = room.sweep(laser, T_map_sensor, twist, 0.0);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double off = std::abs(still.ranges[i] - truth.ranges[i]);
      if (isReturn(still.ranges[i]) && off < 0.5) largest = std::max(largest, off);
    }
  }
  return largest;
}

TEST(MotionCompensation, FollowsARobotThatSpeedsUp) {
  EXPECT_LT(errorWhileSpeedingUp(0.5), 0.05);
  EXPECT_LT(errorWhileSpeedingUp(1.0), 0.07);
  EXPECT_LT(errorWhileSpeedingUp(0.0), 0.1);
}

TEST(MotionCompensation, UndoesTheLastScanByAnotherMotion) {
  const SweptRoom room;
  const Twist twist{{0.2, 0.0}, 1.0};
  for (const double sweep : {0.1, -0.1}) {
    MotionCompensation compensation(sweep);
    const auto scanAt = [&](double time) {
      return room.sweep(kFullTurn, moveBy(twist, time), twist, sweep);
    };
    // The odometry counts half of the way.
    const auto half = [&](double time) { return SensorReading{moveBy(twist, 0.5 * time), time}; };
    EXPECT_FALSE(compensation.undone().has_value());
    compensation.undistort(scanAt(0.0), {half(0.0)});
    const Scan wrong = compensation.undistort(scanAt(0.1), {half(0.1)});
    ASSERT_TRUE(compensation.undone().has_value());
    EXPECT_EQ(compensation.undone()->sense, sweep > 0.0 ? 1.0 : -1.0);
    for (const Pose2& way :
         {compensation.undone()->motion.before, compensation.undone()->motion.after}) {
      EXPECT_NEAR(way.x, 0.005, 5e-4);
      EXPECT_NEAR(way.theta, 0.025, 1e-9);
    }
    const Pose2 way{0.01, 0.0, 0.05};
    const Scan right = compensation.undistortBy({way, way});
    const Scan truth = room.sweep(kFullTurn, moveBy(twist, 0.1), twist, 0.0);
    double off_wrong = 0.0, off_right = 0.0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      if (!isReturn(wrong.ranges[k]) || !isReturn(right.ranges[k])) continue;
      off_wrong += std::min(0.1, std::abs(wrong.ranges[k] - truth.ranges[k]));
      off_right += std::min(0.1, std::abs(right.ranges[k] - truth.ranges[k]));
    }
    EXPECT_LT(off_right, 0.2 * off_wrong);
  }
}

TEST(MotionCompensation, OdometryThatBeginsAnewIsNoMotion) {
  const SweptRoom room;
  MotionCompensation compensation(0.1);
  const Twist twist{{0.2, 0.0}, 0.0};
  for (int k = 0; k < 8; ++k) {
    const bool has_begun_anew = k >= 4;
    const Pose2 T_odom_sensor{has_begun_anew ? 0.02 * k : 9.0 + 0.02 * k, 0.0, 0.0};
    const Scan scan = room.sweep(kFullTurn, moveBy(twist, 0.1 * k), twist, 0.1);
    const Scan still = compensation.undistort(scan, {SensorReading{T_odom_sensor, 0.1 * k}});
    if (k == 4) {
      EXPECT_EQ(still.ranges, scan.ranges);
    }
    EXPECT_EQ(compensation.undone().has_value(), k % 4 != 0) << k;
  }
}

TEST(MotionCompensation, ARobotThatStandsLeavesNothingToUndo) {
  const SweptRoom room;
  MotionCompensation compensation(0.1);
  for (int k = 0; k < 3; ++k)
    compensation.undistort(room.sweep(kFullTurn, {}, {}, 0.1), {SensorReading{{}, 0.1 * k}});
  EXPECT_FALSE(compensation.undone().has_value());
}

}  // namespace
}  // namespace cca::motion_compensation_test
