// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/icp_localiser.hpp"

#include "cca_mrpt/localisation/wheel_odometry.hpp"
#include "icp_matcher.hpp"
#include "io/files/late_library.hpp"

namespace cca {

IcpLocaliser::IcpLocaliser(const IcpParameters& parameters) {
  static auto* const make =
      reinterpret_cast<MakeIcpMatcher*>(lateFunction(kIcpLibrary, kMakeIcpMatcher));
  matcher_.reset(make(parameters));
}

IcpLocaliser::~IcpLocaliser() = default;

Estimate IcpLocaliser::update(const Measurement& measurement, const AnalysedScan& analysed,
                              const PastScans& /*past*/) {
  if (!T_map_start_) T_map_start_ = startOf(measurement);
  Estimate estimate;
  estimate.T_map_robot = *T_map_start_ * matcher_->locate(analysed.scan, measurement.T_robot_sensor,
                                                          measurement.T_odom_robot);
  estimate.T_map_sensor = estimate.T_map_robot * measurement.T_robot_sensor;
  return estimate;
}

}  // namespace cca
