// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/localisation/given_poses.hpp"

namespace cca {

Estimate GivenPoses::update(const Measurement& measurement, const AnalysedScan& analysed,
                            const PastScans& /*past*/) {
  Estimate estimate;
  estimate.is_known = measurement.T_map_robot.has_value();
  if (!estimate.is_known) return estimate;
  estimate.T_map_robot = *measurement.T_map_robot;
  estimate.T_map_sensor = analysed.scan.T_map_sensor;
  return estimate;
}

}  // namespace cca
