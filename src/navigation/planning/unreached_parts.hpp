// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "navigation/planning/planning_scene.hpp"

namespace cca {

/// A connected part of what is in view where the robot could stand, had it found a way there: the
/// inside of a ring of chairs, a room behind glass.
struct UnreachedPart {
  double area = 0.0;                                    ///< m^2
  Eigen::Vector2d place_map = Eigen::Vector2d::Zero();  ///< m, map frame: the cell in its middle
  /// A disc of the robot's own radius may get there, as far as the cells tell: a surface may lie
  /// half a cell before them. The planner keeps more, or was held on the way.
  bool may_be_passable = false;
};

/// The parts of a quarter of a square metre at least that the ways last found do not lead to, the
/// largest first.
/// @param robot_map  m, map frame, where those ways begin.
/// @param radius     m, of the robot.
/// Cost: O(cells between the corners of what is known / 16); where there are such parts, that of
/// marking all known cells anew and of a search over the known blocks.
std::vector<UnreachedPart> unreachedParts(const PlanningScene& scene,
                                          const Eigen::Vector2d& robot_map, double radius);

}  // namespace cca
