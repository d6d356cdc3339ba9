// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cca_mrpt/io/icp_localiser.hpp"

namespace cca {

/// MRPT's side of IcpLocaliser, behind lateFunction().
class IcpMatcher {
 public:
  virtual ~IcpMatcher() = default;
  /// T_start_robot: the first one is the identity.
  virtual Pose2 locate(const Scan& scan, const Pose2& T_robot_sensor,
                       const std::optional<Pose2>& T_odom_robot) = 0;
};

using MakeIcpMatcher = IcpMatcher*(const IcpParameters&);
constexpr const char* kIcpLibrary = "libcca_icp.so";
constexpr const char* kMakeIcpMatcher = "makeIcpMatcher";

}  // namespace cca
