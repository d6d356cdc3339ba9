// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/slam_localiser.hpp"

#include "cca_mrpt/localisation/wheel_odometry.hpp"

namespace cca {

Estimate SlamLocaliser::update(const Measurement& measurement, const AnalysedScan& analysed,
                               const PastScans& /*past*/) {
  if (!has_started_) slam_.startAt(startOf(measurement));
  has_started_ = true;
  const SlamPose pose = slam_.step(analysed, measurement.T_robot_sensor, measurement.T_odom_robot);
  Estimate estimate;
  estimate.T_map_robot = pose.T_map_robot;
  estimate.T_map_sensor = pose.T_map_robot * measurement.T_robot_sensor;
  estimate.covariance = pose.covariance;
  estimate.agreement = pose.agreement;
  estimate.is_known = !pose.is_lost;
  estimate.was_corrected = pose.version != version_;
  version_ = pose.version;
  return estimate;
}

}  // namespace cca
