// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <tuple>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// Logs tell lasers apart by where they are on the robot: to the millimetre and the milliradian,
/// since who writes a place as the difference of two poses writes its last digits anew each time.
using LaserPlace = std::tuple<long, long, long>;

inline LaserPlace laserPlace(const Pose2& T_robot_sensor) {
  constexpr double kTold = 1e-3;  // m, rad
  return {std::lround(T_robot_sensor.x / kTold), std::lround(T_robot_sensor.y / kTold),
          std::lround(T_robot_sensor.theta / kTold)};
}

}  // namespace cca
