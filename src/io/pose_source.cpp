// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/pose_source.hpp"

#include <cassert>
#include <stdexcept>

namespace cca {
namespace {

Pose2 needed(const std::optional<Pose2>& pose, const char* what) {
  if (!pose) throw std::runtime_error(std::string("the log holds no ") + what);
  return *pose;
}

}  // namespace

Pose2 logPose(const LogRecord& record) {
  return record.scan.T_map_sensor * record.T_robot_sensor.inverse();
}

PoseKind poseKind(const std::string& name) {
  if (name == "log") return PoseKind::kLog;
  if (name == "odometry") return PoseKind::kOdometry;
  if (name == "icp") return PoseKind::kIcp;
  if (name == "truth") return PoseKind::kTruth;
  if (name == "slam") return PoseKind::kSlam;
  throw std::runtime_error("pose source '" + name + "': one of log, slam, odometry, icp, truth");
}

std::optional<Pose2> referencePose(const LogRecord& record) {
  return record.truth ? record.truth : record.corrected;
}

Pose2 PoseSource::locate(const LogRecord& record) {
  if (kind_ == PoseKind::kLog) return logPose(record);
  assert(kind_ != PoseKind::kSlam);
  if (kind_ == PoseKind::kTruth) return needed(record.truth, "true poses");
  // Errors can be told only where the first pose is the reference's.
  const Pose2 start = referencePose(record).value_or(logPose(record));
  if (kind_ == PoseKind::kOdometry) {
    const Pose2 T_odom_robot = needed(record.odometry, "odometry");
    if (!T_map_odom_) T_map_odom_ = start * T_odom_robot.inverse();
    return *T_map_odom_ * T_odom_robot;
  }
  if (!localizer_) localizer_.emplace(start, icp_);
  unguided_ += !record.odometry;
  return localizer_->locate(record.scan, record.T_robot_sensor, record.odometry);
}

Pose2 PoseSource::place(LogRecord& record) {
  const Pose2 T_map_robot = locate(record);
  if (kind_ != PoseKind::kLog) record.scan.T_map_sensor = T_map_robot * record.T_robot_sensor;
  return T_map_robot;
}

std::string PoseSource::warnings() const {
  if (unguided_ == 0) return "";
  return std::to_string(unguided_) +
         " scan(s) without odometry, which ICP looked for where the one before was";
}

}  // namespace cca
