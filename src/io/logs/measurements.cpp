// SPDX-License-Identifier: BSD-3-Clause
#include "io/logs/measurements.hpp"

#include <stdexcept>

namespace cca {
namespace {

void require(bool is_there, const char* what) {
  if (!is_there) throw std::runtime_error(std::string("the log holds no ") + what);
}

}  // namespace

const char* nameOf(PoseSource source) {
  for (const auto& [name, named] : kPoseSourceNames) {
    if (named == source) return name;
  }
  return "";
}

PoseSource poseSource(const std::string& name) {
  std::string allowed;
  for (const auto& [known, source] : kPoseSourceNames) {
    if (name == known) return source;
    allowed += (allowed.empty() ? "" : ", ") + std::string(known);
  }
  throw std::runtime_error("pose source '" + name + "': one of " + allowed);
}

Pose2 logPose(const LogRecord& record) {
  return record.scan.T_map_sensor * record.T_robot_sensor.inverse();
}

std::optional<Pose2> referencePose(const LogRecord& record) {
  return record.truth ? record.truth : record.corrected;
}

Measurement measurementOf(LogRecord record, PoseSource source) {
  if (source == PoseSource::kTruth) require(record.truth.has_value(), "true poses");
  if (source == PoseSource::kOdometry) require(record.odometry.has_value(), "odometry");
  Measurement measurement;
  measurement.T_robot_sensor = record.T_robot_sensor;
  measurement.T_odom_robot = record.odometry;
  measurement.undone = record.undone;
  measurement.time = record.has_time ? record.time : 0.0;
  // Poses that somebody has corrected are not for who is to find his own.
  if (record.odometry || source == PoseSource::kLog) measurement.motion = record.motion;
  if (source == PoseSource::kLog) {
    measurement.T_map_robot = logPose(record);
  } else {
    // Errors can be told only where the first pose is the reference's.
    measurement.T_map_robot = referencePose(record).value_or(logPose(record));
    record.scan.T_map_sensor = *measurement.T_map_robot * record.T_robot_sensor;
  }
  measurement.scan = std::move(record.scan);
  return measurement;
}

}  // namespace cca
