// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/known_map/known_map.hpp"

namespace cca::apps {

/// Tells a localiser where the robot is as people do: half a metre and 15 degrees are two sigmas.
inline void placeAbout(const Pose2& T_map_robot, KnownMap& localiser) {
  const Eigen::Vector3d sigmas(0.25, 0.25, 0.13);  // m, m, rad
  localiser.place(T_map_robot, sigmas.cwiseAbs2().asDiagonal());
}

}  // namespace cca::apps
