// SPDX-License-Identifier: BSD-3-Clause
#include "io/poses/monte_carlo.hpp"

#include "icp_matcher.hpp"
#include "io/files/late_library.hpp"

namespace cca {

MonteCarlo::MonteCarlo(const std::vector<PlanLine>& plan, const Pose2& T_map_start,
                       const MonteCarloSettings& settings) {
  auto* const make =
      reinterpret_cast<MakeMonteCarloFilter*>(lateFunction(kIcpLibrary, kMakeMonteCarloFilter));
  filter_.reset(make(plan, T_map_start, settings));
}

Estimate MonteCarlo::update(const Measurement& measurement, const AnalysedScan& analysed,
                            const PastScans& /*past*/) {
  Estimate estimate =
      filter_->step(analysed.scan, measurement.T_robot_sensor, measurement.T_odom_robot);
  estimate.T_map_sensor = estimate.T_map_robot * measurement.T_robot_sensor;
  return estimate;
}

}  // namespace cca
