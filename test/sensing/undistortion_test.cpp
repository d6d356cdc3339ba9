// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/undistortion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "swept_room.hpp"

namespace cca::undistortion_test {
namespace {

TEST(Twist, LeadsFromPoseToPose) {
  const Pose2 from{1.0, 2.0, 3.0};
  for (const Pose2& to : {Pose2{1.3, 2.2, -2.9}, Pose2{1.0, 2.0, 3.0}, Pose2{0.5, 2.0, 3.0}}) {
    const Pose2 reached = from * moveBy(twistBetween(from, to, 0.2), 0.2);
    EXPECT_NEAR(reached.x, to.x, 1e-12);
    EXPECT_NEAR(reached.y, to.y, 1e-12);
    EXPECT_NEAR(wrapAngle(reached.theta - to.theta), 0.0, 1e-12);
  }
}

TEST(Twist, OfALaserBesideTheTurningCentreHasItsLeverArm) {
  const Pose2 T_robot_sensor{0.3, -0.1, 2.0};
  const Twist robot{{0.4, 0.0}, 1.2};
  const Pose2 moved = moveBy(robot, 0.1) * T_robot_sensor;
  const Pose2 reached = T_robot_sensor * moveBy(sensorTwist(robot, T_robot_sensor), 0.1);
  EXPECT_NEAR(reached.x, moved.x, 1e-12);
  EXPECT_NEAR(reached.y, moved.y, 1e-12);
  EXPECT_NEAR(wrapAngle(reached.theta - moved.theta), 0.0, 1e-12);
}

/// m, the share of beams that differ from what a scan of one instant shows by more than 2 cm.
double shareOff(const Scan& scan, const Scan& truth) {
  double off = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    off += isReturn(scan.ranges[i]) && std::abs(scan.ranges[i] - truth.ranges[i]) > 0.02;
  }
  return off / static_cast<double>(scan.size());
}

struct Case {
  double first_deg, increment_deg;
  int beams;
  Twist sensor;
  double duration;
};

class Undistortion : public ::testing::TestWithParam<Case> {};

TEST_P(Undistortion, GivesTheScanOfTheMiddle) {
  const Case& c = GetParam();
  const SweptRoom room;
  const Laser laser{c.first_deg * M_PI / 180.0, c.increment_deg * M_PI / 180.0, c.beams};
  const Pose2 T_map_sensor{0.7, -0.4, 0.3};
  const Scan swept = room.sweep(laser, T_map_sensor, c.sensor, c.duration);
  const Scan truth = room.sweep(laser, T_map_sensor, c.sensor, 0.0);
  const Scan still = undistort(swept, c.sensor);
  EXPECT_EQ(still.sweep_duration, 0.0);
  EXPECT_GT(shareOff(swept, truth), 0.3);
  EXPECT_LT(shareOff(still, truth), 0.05);  // edges of what hides what
  const auto lost = std::count_if(still.ranges.begin(), still.ranges.end(),
                                  [](double range) { return !isReturn(range); });
  // What the turning laser has not seen.
  const double gap = std::abs(c.sensor.angular * c.duration / laser.increment);
  EXPECT_LE(static_cast<double>(lost), gap + 2.0);
}

INSTANTIATE_TEST_SUITE_P(OfCommonLasers, Undistortion,
                         ::testing::Values(Case{-180, 1, 360, {{0.0, 0.0}, 1.0}, 0.18},
                                           Case{-180, 1, 360, {{0.5, 0.1}, -1.0}, 0.18},
                                           Case{-180, 1, 360, {{0.3, 0.0}, 1.0}, -0.18},
                                           Case{-180, 2, 180, {{0.0, 0.0}, 1.7}, 0.13},
                                           Case{-135, 0.25, 1081, {{0.7, 0.0}, 1.5}, 0.05},
                                           Case{120, -0.352, 682, {{0.5, 0.0}, -1.5}, 0.067}));

TEST(UndistortionOf, AScanWithoutSweepOrWithoutMotionChangesNothing) {
  const SweptRoom room;
  const Scan scan = room.sweep({-M_PI, M_PI / 180.0, 360}, {}, {{0.5, 0.0}, 1.0}, 0.18);
  Scan instant = scan;
  instant.sweep_duration = 0.0;
  EXPECT_EQ(undistort(instant, {{0.5, 0.0}, 1.0}).ranges, scan.ranges);
  EXPECT_EQ(undistort(scan, {}).ranges, scan.ranges);
}

TEST(UndistortionOf, MissingReturnsTurnsThemWithTheBeams) {
  Scan scan;
  scan.angle_min = -M_PI;
  scan.angle_increment = M_PI / 180.0;
  scan.ranges.assign(360, 3.0);
  std::fill_n(scan.ranges.begin() + 340, 10, HUGE_VAL);
  scan.sweep_duration = 0.18;
  // These were taken 0.083 to 0.078 s after the middle, 5 degrees farther on.
  const Scan still = undistort(scan, {{0.0, 0.0}, 1.0});
  for (const int beam : {346, 350, 353}) EXPECT_TRUE(isNoReturn(still.ranges[beam])) << beam;
  for (const int beam : {343, 357}) EXPECT_TRUE(isReturn(still.ranges[beam])) << beam;
}

// Neighbours on it differ in range by a tenth and more from 6 m on, as at a step in depth.
TEST(UndistortionOf, AWallThatBeamsGrazeStaysStraight) {
  constexpr int kBeams = 360;
  constexpr double kTurn = 1.3, kSweep = 0.18;
  Scan scan;
  scan.angle_min = -M_PI;
  scan.angle_increment = M_PI / 180.0;
  scan.sweep_duration = kSweep;
  for (std::size_t i = 0; i < kBeams; ++i) {  // in the middle of a corridor, 2 m wide
    const double time = kSweep * (static_cast<double>(i) / (kBeams - 1.0) - 0.5);
    const double range = 1.0 / std::abs(std::sin(scan.bearing(i) + kTurn * time));
    scan.ranges.push_back(range < 12.0 ? range : HUGE_VAL);
  }
  const Scan still = undistort(scan, {{0.0, 0.0}, kTurn});
  int far = 0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    if (!isReturn(still.ranges[i]) || still.ranges[i] > 9.0) continue;
    far += still.ranges[i] > 6.0;
    EXPECT_NEAR(std::abs(still.ranges[i] * std::sin(still.bearing(i))), 1.0, 0.005) << i;
  }
  EXPECT_GE(far, 8);
}

TEST(UndistortionOf, AStepInDepthLeavesNoPointBetween) {
  const SweptRoom room;
  const Scan still =
      undistort(room.sweep({-M_PI, M_PI / 180.0, 360}, {0.7, -0.4, 0.3}, {{0.4, 0.0}, 1.3}, 0.18),
                {{0.4, 0.0}, 1.3});
  for (std::size_t i = 0; i < still.size(); ++i) {
    if (!isReturn(still.ranges[i])) continue;
    const double angle = 0.3 + still.bearing(i);
    const Eigen::Vector2d p = Eigen::Vector2d(0.7, -0.4) +
                              still.ranges[i] * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    // Beside an edge a return is turned to the next bearing: half a beam of 5 m.
    EXPECT_LT(room.distance(p), 0.044) << i;
  }
}

/// A wall that the laser grazes, 1 m beside it, ends 7.12 m ahead; beyond is another, 10 m ahead.
TEST(Undistortion, MovesNoReturnFarBeyondWhereItsSurfaceEnds) {
  Scan scan;
  scan.angle_increment = 0.5 * M_PI / 180.0;
  scan.sweep_duration = 0.2;
  for (int i = 0; i < 180; ++i) {
    const double bearing = scan.bearing(static_cast<std::size_t>(i));
    const double to_side = 1.0 / std::max(std::sin(bearing), 1e-9);
    scan.ranges.push_back(to_side * std::cos(bearing) < 7.12 ? to_side : 10.0 / std::cos(bearing));
  }
  for (double turning = 0.2; turning < 0.6; turning += 0.03) {
    const Scan still = undistort(scan, {{0.0, 0.0}, turning});
    EXPECT_GT(still.bearing_sigma, 0.2 * scan.angle_increment);
    for (std::size_t i = 0; i < still.size(); ++i) {
      if (!isReturn(still.ranges[i])) continue;
      const Eigen::Vector2d p =
          still.ranges[i] * Eigen::Vector2d(std::cos(still.bearing(i)), std::sin(still.bearing(i)));
      if (p.x() > 9.5) continue;
      EXPECT_LT(p.norm(), std::hypot(7.12, 1.0) + 0.1) << turning << " " << i;
    }
  }
}

// While it turns by the spacing of its beams the last one comes to lie on the first one, and noise
// decides in which direction the two point.
TEST(Undistortion, ShowsNoReturnOffTheWallsWhereTheSweepMeetsItself) {
  constexpr double kSpacing = 0.8 * M_PI / 180.0, kSweep = 0.1;
  const SweptRoom room;
  std::mt19937 random(1);
  for (const double sense : {-1.0, 1.0}) {
    for (int k = -200; k <= 200; ++k) {
      const Twist twist{{0.0, 0.0}, sense * kSpacing / kSweep * (1.0 + 1e-4 * k)};
      Scan scan = room.sweep({-M_PI, kSpacing, 450}, {}, twist, kSweep);
      for (double& range : scan.ranges) range += 0.03 * (random() / 4294967295.0 - 0.5);
      const Scan still = undistort(scan, twist);
      for (std::size_t i = 0; i < still.size(); ++i) {
        if (!isReturn(still.ranges[i])) continue;
        const double bearing = still.bearing(i);
        const Eigen::Vector2d p =
            still.ranges[i] * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
        EXPECT_LT(room.distance(p), 0.15) << "beam " << i << ", rate " << k;
      }
    }
  }
}

TEST(Undistortion, SaysNothingOfTheBearingsWhereNothingIsUndone) {
  const SweptRoom room;
  const Scan scan = room.sweep({-M_PI, M_PI / 180.0, 360}, {}, {}, 0.1);
  EXPECT_EQ(undistort(scan, {}).bearing_sigma, 0.0);
}

}  // namespace
}  // namespace cca::undistortion_test
