// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/icp_localizer.hpp"

#include "cca_mrpt/io/late_library.hpp"
#include "icp_matcher.hpp"

namespace cca {

IcpLocalizer::IcpLocalizer(const Pose2& T_map_start, const IcpParameters& parameters)
    : T_map_start_(T_map_start) {
  static auto* const make =
      reinterpret_cast<MakeIcpMatcher*>(lateFunction(kIcpLibrary, kMakeIcpMatcher));
  matcher_.reset(make(parameters));
}

IcpLocalizer::~IcpLocalizer() = default;
IcpLocalizer::IcpLocalizer(IcpLocalizer&&) noexcept = default;
IcpLocalizer& IcpLocalizer::operator=(IcpLocalizer&&) noexcept = default;

Pose2 IcpLocalizer::locate(const Scan& scan, const Pose2& T_robot_sensor,
                           const std::optional<Pose2>& T_odom_robot) {
  return T_map_start_ * matcher_->locate(scan, T_robot_sensor, T_odom_robot);
}

}  // namespace cca
