// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// The robot to look at: its disc, an arrow ahead, and below it (as seen from above, north up) what
/// it does. @param radius  m.
visualization_msgs::MarkerArray robotMarkers(const Pose2& T_map_robot, double radius,
                                             const std::string& words,
                                             const std_msgs::Header& header);

}  // namespace cca
