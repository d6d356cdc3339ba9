// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/localisation/wheel_odometry.hpp"

namespace cca {

Pose2 startOf(const Measurement& first) {
  if (first.T_map_robot) return *first.T_map_robot;
  return first.T_odom_robot.value_or(Pose2{});
}

Estimate WheelOdometry::update(const Measurement& measurement, const AnalysedScan& /*analysed*/,
                               const PastScans& /*past*/) {
  if (!T_map_odom_) {
    const Pose2 T_odom_robot = measurement.T_odom_robot.value_or(Pose2{});
    T_map_odom_ = startOf(measurement) * T_odom_robot.inverse();
    T_map_robot_ = *T_map_odom_ * T_odom_robot;
  } else if (measurement.T_odom_robot) {
    T_map_robot_ = *T_map_odom_ * *measurement.T_odom_robot;
  }
  Estimate estimate;
  estimate.T_map_robot = T_map_robot_;
  estimate.T_map_sensor = T_map_robot_ * measurement.T_robot_sensor;
  return estimate;
}

}  // namespace cca
