// SPDX-License-Identifier: BSD-3-Clause
//
// A laser whose sweep nobody tells, behind the session that every door leads to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "../sensing/swept_room.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/localisation/wheel_odometry.hpp"
#include "cca_mrpt/session/mapping_session.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "counting_recorder.hpp"

namespace cca::sweeping_laser_test {
namespace {

constexpr double kPeriod = 0.18;  // s; so long is the sweep
constexpr int kScans = 200;
const Laser kLaser{-M_PI, M_PI / 180.0, 360};
const SweptRoom kRoom;

/// A robot that drives a small circle, stands, and drives it back.
/// @param scale  of the turns, as the odometry counts them.
std::vector<Measurement> drive(bool has_odometry, double scale = 1.01) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.005);
  std::vector<Measurement> measurements;
  Pose2 T_map_robot{-0.5, -1.0, 0.0}, T_odom_robot;
  double rate = 0.0;
  for (int k = 0; k < kScans; ++k) {
    const double wanted = k % 100 < 10 ? 0.0 : k < 100 ? 0.9 : -0.9;
    const double before = rate;
    rate += std::clamp(wanted - rate, -0.2, 0.2);
    const double mean = 0.5 * (before + rate);
    if (k > 0) T_map_robot = T_map_robot * moveBy({{0.3 * std::abs(mean), 0.0}, mean}, kPeriod);
    if (k > 0) {
      T_odom_robot = T_odom_robot * moveBy({{0.3 * std::abs(mean), 0.0}, scale * mean}, kPeriod);
    }
    Measurement measurement;
    measurement.scan =
        kRoom.sweep(kLaser, T_map_robot, {{0.3 * std::abs(rate), 0.0}, rate}, kPeriod);
    measurement.scan.sweep_duration = 0.0;
    for (double& range : measurement.scan.ranges) range += noise(random);
    measurement.time = 10.0 + kPeriod * k;
    measurement.T_map_robot = T_map_robot;
    if (has_odometry) measurement.T_odom_robot = T_odom_robot;
    measurements.push_back(measurement);
  }
  return measurements;
}

/// m, the share of the lines' ends that lie on no wall.
double wrongEnds(const LineMap& map) {
  double wrong = 0.0, all = 0.0;
  for (const MapLine& line : map.lines()) {
    for (const Eigen::Vector2d& end : {line.segment.start, line.segment.end}) {
      wrong += kRoom.distance(end) > 0.03;
      ++all;
    }
  }
  return wrong / all;
}

LineMap mapOf(std::unique_ptr<Localiser> localiser, bool has_odometry,
              const std::optional<double>& sweep = {}) {
  MappingSession::Settings settings;
  settings.sweep = sweep;
  MappingSession session(std::move(localiser), settings);
  for (const Measurement& measurement : drive(has_odometry)) session.add(measurement);
  session.finish();
  return session.lineMap();
}

TEST(SweepingLaser, ItsWallsAreStraightOnceItsSweepIsKnown) {
  const LineMap learned = mapOf(std::make_unique<SlamLocaliser>(), true);
  const LineMap bent = mapOf(std::make_unique<SlamLocaliser>(), true, 0.0);
  EXPECT_LE(learned.lines().size(), 14U);  // twelve edges
  EXPECT_LT(wrongEnds(learned), 0.1);
  EXPECT_GT(bent.lines().size(), learned.lines().size());
}

/// m, how far the returns lie from the walls, by wheels that count turns so.
double offAtGivenPoses(double scale) {
  MappingSession::Settings settings;
  settings.sweep = kPeriod;
  MappingSession session(std::make_unique<GivenPoses>(), settings);
  double off = 0.0, returns = 0.0;
  for (const Measurement& measurement : drive(true, scale)) {
    session.add(measurement);
    const Scan& scan = session.scan();
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (!isReturn(scan.ranges[i])) continue;
      const double angle = scan.bearing(i);
      off += kRoom.distance(
          measurement.T_map_robot.value() *
          Eigen::Vector2d(scan.ranges[i] * std::cos(angle), scan.ranges[i] * std::sin(angle)));
      ++returns;
    }
  }
  return off / returns;
}

TEST(SweepingLaser, AtGivenPosesItsScansTellWhatTheWheelsGetWrong) {
  EXPECT_LT(offAtGivenPoses(1.15), 1.3 * offAtGivenPoses(1.0));
}

// A simulator tells the true pose with each measurement, to those who are to believe it.
TEST(SweepingLaser, WhoDoesNotBelieveTheGivenPosesDoesNotUseThem) {
  MappingSession::Settings settings;
  settings.sweep = kPeriod;
  MappingSession told(std::make_unique<WheelOdometry>(), settings);
  MappingSession alone(std::make_unique<WheelOdometry>(), settings);
  bool is_first = true;
  for (Measurement measurement : drive(true, 1.15)) {
    told.add(measurement);
    if (!is_first) measurement.T_map_robot.reset();
    is_first = false;
    alone.add(measurement);
    ASSERT_EQ(told.scan().bearing_sigma, alone.scan().bearing_sigma);
    for (std::size_t i = 0; i < told.scan().size(); ++i) {
      const double a = told.scan().ranges[i], b = alone.scan().ranges[i];
      ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << i;
    }
  }
}

TEST(SweepingLaser, TheScansBeforeItsSweepIsKnownAreMappedAnew) {
  CountingRecorder recorder;
  MappingSession session(std::make_unique<GivenPoses>(), {}, &recorder);
  const std::vector<Measurement> measurements = drive(true);
  for (Measurement measurement : measurements) {
    measurement.scan.T_map_sensor = *measurement.T_map_robot;
    session.add(measurement);
  }
  EXPECT_EQ(recorder.restarts, 1);
  ASSERT_EQ(recorder.numbers.size(), measurements.size());
  for (std::size_t k = 0; k < recorder.numbers.size(); ++k) EXPECT_EQ(recorder.numbers[k], k);
  EXPECT_EQ(session.trajectory().size(), measurements.size());
  EXPECT_LT(wrongEnds(session.lineMap()), 0.1);
}

TEST(SweepingLaser, ItsMapDoesNotDependOnWhenItIsLookedAt) {
  MappingSession::Settings late;
  late.maps_at_the_end = true;
  MappingSession online(std::make_unique<SlamLocaliser>(), {});
  MappingSession at_the_end(std::make_unique<SlamLocaliser>(), late);
  bool was_corrected = false;
  for (const Measurement& measurement : drive(true)) {
    was_corrected = online.add(measurement).was_corrected || was_corrected;
    at_the_end.add(measurement);
  }
  EXPECT_TRUE(was_corrected);
  online.finish();
  at_the_end.finish();
  const auto a = online.lineMap().lines(), b = at_the_end.lineMap().lines();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].segment.start, b[k].segment.start);
}

TEST(SweepingLaser, WithoutWheelsTheLastPosesTellItsMotion) {
  const LineMap own = mapOf(std::make_unique<SlamLocaliser>(), false, kPeriod);
  const LineMap bent = mapOf(std::make_unique<SlamLocaliser>(), false, 0.0);
  EXPECT_LE(own.lines().size(), 14U);
  EXPECT_LT(wrongEnds(own), 0.1);
  EXPECT_GT(bent.lines().size(), own.lines().size());
}

TEST(SweepingLaser, WhoMovesAlongIsToldFromWhere) {
  MappingSession session(std::make_unique<SlamLocaliser>(), {});
  for (const Measurement& measurement : drive(true)) {
    const std::vector<Pose2> before = session.trajectory();
    const Estimate estimate = session.add(measurement);
    if (!estimate.was_corrected) continue;
    const PastScans::Kept& first = session.past().kept().front();
    EXPECT_NEAR(first.T_was_robot.x, before.front().x, 1e-9);
    EXPECT_NEAR(first.T_map_robot.x, session.trajectory().front().x, 1e-9);
  }
}

}  // namespace
}  // namespace cca::sweeping_laser_test
