// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "io/logs/log_info.hpp"
#include "io/logs/rawlog_writer.hpp"
#include "io/poses/pose_source.hpp"
#include "io/poses/trajectory_error.hpp"
#include "temporary_folder.hpp"

namespace cca {
namespace {

/// A laser in a room of 8 m x 5 m, seen without noise.
Scan roomScan(const Pose2& T_map_sensor) {
  Scan scan;
  scan.angle_min = -M_PI;
  scan.angle_increment = M_PI / 180.0;
  for (int beam = 0; beam < 360; ++beam) {
    const double bearing = T_map_sensor.theta + scan.bearing(static_cast<std::size_t>(beam));
    const double c = std::cos(bearing), s = std::sin(bearing);
    const double to_x = c > 0.0 ? (4.0 - T_map_sensor.x) / c : (-4.0 - T_map_sensor.x) / c;
    const double to_y = s > 0.0 ? (2.5 - T_map_sensor.y) / s : (-2.5 - T_map_sensor.y) / s;
    scan.ranges.push_back(std::min(c == 0.0 ? HUGE_VAL : to_x, s == 0.0 ? HUGE_VAL : to_y));
  }
  return scan;
}

/// A slow circle whose odometry turns 5 % too far and runs 3 % too long.
LogRecord onCircle(int k) {
  const double angle = 0.05 * k;
  LogRecord record;
  record.truth = Pose2{2.0 * std::sin(angle), -std::cos(angle), wrapAngle(0.7 * angle)};
  record.odometry =
      Pose2{2.06 * std::sin(1.05 * angle), -std::cos(1.05 * angle), wrapAngle(0.74 * angle)};
  record.scan = roomScan(*record.truth);
  record.scan.T_map_sensor = *record.odometry;
  return record;
}

std::vector<Pose2> localised(PoseSource source, const std::vector<LogRecord>& log) {
  const std::unique_ptr<Localiser> localiser = makeLocaliser(source);
  std::vector<Pose2> poses;
  for (const LogRecord& record : log) {
    const Measurement measurement = measurementOf(record, source);
    poses.push_back(localiser->update(measurement, {measurement.scan, {}, {}}, {}).T_map_robot);
  }
  return poses;
}

TEST(PoseSource, IcpUndoesWhatTheWheelsGetWrong) {
  std::vector<LogRecord> log;
  std::vector<Pose2> truth;
  for (int k = 0; k < 60; ++k) {
    log.push_back(onCircle(k));
    truth.push_back(*log.back().truth);
  }
  const std::vector<Pose2> odometry = localised(PoseSource::kOdometry, log);
  const double odometry_error = compareTrajectories(odometry, truth).at_end_m;
  EXPECT_GT(odometry_error, 0.1);
  const std::vector<Pose2> icp = localised(PoseSource::kIcp, log);
  EXPECT_LT(compareTrajectories(icp, truth).at_end_m, 0.2 * odometry_error);
}

TEST(PoseSource, IcpLooksForAScanWithoutOdometryWhereTheOneBeforeWas) {
  const Pose2 T_far_odom{100.0, -50.0, 1.0};  // odometry need not begin at its origin
  std::vector<LogRecord> log;
  std::vector<Pose2> truth;
  for (int k = 0; k < 60; ++k) {
    LogRecord record = onCircle(k);
    record.odometry = T_far_odom * *record.odometry;
    if (k < 3 || k == 20 || (k >= 30 && k < 40)) record.odometry.reset();
    truth.push_back(*record.truth);
    log.push_back(record);
  }
  EXPECT_LT(compareTrajectories(localised(PoseSource::kIcp, log), truth).max_m, 0.1);
}

TEST(PoseSource, TheLogsOwnPosesAreBelievedToTheBit) {
  LogRecord record = onCircle(7);
  record.T_robot_sensor = {0.123, -0.045, 0.6};
  record.scan.T_map_sensor = {1.0 / 3.0, 2.0 / 7.0, 0.1};
  const Measurement measurement = measurementOf(record, PoseSource::kLog);
  const Estimate estimate =
      makeLocaliser(PoseSource::kLog)->update(measurement, {measurement.scan, {}, {}}, {});
  EXPECT_EQ(estimate.T_map_sensor.x, record.scan.T_map_sensor.x);
  EXPECT_EQ(estimate.T_map_sensor.y, record.scan.T_map_sensor.y);
  EXPECT_EQ(estimate.T_map_sensor.theta, record.scan.T_map_sensor.theta);
}

TEST(PoseSource, WhatTheLogDoesNotHoldIsNamed) {
  LogRecord record = onCircle(0);
  record.odometry.reset();
  record.truth.reset();
  EXPECT_THROW(measurementOf(record, PoseSource::kOdometry), std::runtime_error);
  EXPECT_THROW(measurementOf(record, PoseSource::kTruth), std::runtime_error);
  EXPECT_THROW(poseSource("gps"), std::runtime_error);
}

TEST(TrajectoryError, IsNoneForATrajectoryMovedRigidly) {
  const Pose2 motion{3.0, -2.0, 2.5};
  std::vector<Pose2> truth, moved;
  for (int k = 0; k < 20; ++k) {
    truth.push_back({0.3 * k, std::sin(0.4 * k), wrapAngle(0.2 * k)});
    moved.push_back(motion * truth.back());
  }
  const auto error = compareTrajectories(moved, truth);
  EXPECT_NEAR(error.rms_m, 0.0, 1e-9);
  EXPECT_NEAR(error.rms_deg, 0.0, 1e-6);
  EXPECT_GT(error.at_end_m, 1.0);
}

TEST(TrajectoryError, DegenerateTrajectoriesGiveNumbers) {
  EXPECT_EQ(compareTrajectories({}, {}).rms_m, 0.0);
  EXPECT_NEAR(compareTrajectories({{1, 1, 0}}, {{2, 2, 0}}).rms_m, 0.0, 1e-12);
  const std::vector<Pose2> still(5, Pose2{1, 2, 0});
  EXPECT_NEAR(compareTrajectories(still, still).max_m, 0.0, 1e-12);
}

TEST(TruthFile, BesideALogIsReadWithIt) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.rawlog";
  RawlogWriter writer(path, 20.0);
  for (int k = 0; k < 4; ++k) {
    writer.insert(roomScan({0.1 * k, 0, 0}), {}, {0.1 * k, 0, 0}, 100.0 + k);
  }
  writer.commit();
  std::ofstream(path + ".GT.txt") << "100.5 1 2 3.1\n101.5 3 2 -3.1\n102.5 3 4 0\n";
  const auto log = openLog(path);
  EXPECT_FALSE(log->next()->truth.has_value());  // before the first true pose
  const auto truth = log->next()->truth;
  ASSERT_TRUE(truth.has_value());
  EXPECT_NEAR(truth->x, 2.0, 1e-6);
  EXPECT_NEAR(std::abs(truth->theta), M_PI, 1e-6);
  EXPECT_TRUE(log->next()->truth.has_value());
  EXPECT_FALSE(log->next()->truth.has_value());  // after the last
}

TEST(LogInfo, TellsWhatIsThere) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.rawlog";
  RawlogWriter writer(path, 20.0);
  const double times[] = {10.0, 10.1, 10.2, 10.2, 10.1, 10.4, 15.0};
  for (int k = 0; k < 7; ++k) {
    Scan scan = roomScan({});
    scan.ranges.front() += 0.01 * k;  // a scan that never changes is none
    writer.insert(scan, {0.2, 0, 0}, {0.5 * k, 0, 0}, times[k]);
  }
  writer.commit();
  const auto info = inspectLog(*openLog(path));
  EXPECT_EQ(info["scans"], 7);
  EXPECT_EQ(info["beams"].dump(), "[360,360]");
  EXPECT_NEAR(info["field_of_view_deg"].get<double>(), 359.0, 1e-3);
  EXPECT_NEAR(info["path_m"].get<double>(), 3.0, 1e-3);
  EXPECT_NEAR(info["returns"].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(info["range_m"][0].get<double>(), 2.5, 1e-3);
  EXPECT_EQ(info["time_faults"]["backwards"], 1);
  EXPECT_EQ(info["time_faults"]["repeated"], 1);
  EXPECT_EQ(info["time_faults"]["gaps"], 1);
  EXPECT_EQ(info["poses"]["odometry"], 7);
}

TEST(TrajectoryError, LoopsAreTwoVisitsOfAPlace) {
  // Thirty-two metres out, as many back beside the way out; the way back is off by half a metre.
  std::vector<Pose2> truth, estimate;
  for (int k = 0; k <= 64; ++k) {
    const bool is_back = k > 32;
    truth.push_back({is_back ? 64.0 - k : 1.0 * k, is_back ? 1.0 : 0.0, is_back ? M_PI : 0.0});
    estimate.push_back(truth.back());
    if (is_back) estimate.back().y += 0.5;
  }
  EXPECT_NEAR(loopError(estimate, truth), 0.5, 1e-9);
  EXPECT_NEAR(loopError(truth, truth), 0.0, 1e-12);
  EXPECT_EQ(loopError({}, {}), 0.0);
}

}  // namespace
}  // namespace cca
