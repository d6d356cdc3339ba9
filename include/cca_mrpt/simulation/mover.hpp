// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cca_mrpt/simulation/body.hpp"
#include "cca_mrpt/simulation/world.hpp"

namespace cca {

/// Something that moves about: a person, a trolley. The smallest circle around one keeps out of
/// every obstacle cell and of the circles of all other movers; where it would come into one, it
/// turns (a random walk anywhere, others round). Those whose circles overlap at the start may part.
struct Mover {
  Body body;                                ///< where and how it begins
  double speed = 0.8;                       ///< m/s
  double gap = 0.4;                         ///< m, where it stops before the robot; 0: blind to it
  std::vector<Eigen::Vector2d> way_points;  ///< m; fewer than two: it walks at random
  bool loop = false;                        ///< from the last way-point to the first; else back
};

/// Reads `movers:`, a list of {shape: disc|box, radius | size, speed, gap, and either way_points
/// [[x, y], ...] with loop, or start [x, y] of a random walk}.
/// @throws std::runtime_error naming file, mover, key and what is allowed; also where a mover would
///         have to pass through a wall.
std::vector<Mover> loadMovers(const std::string& yaml_path, const World& world);

}  // namespace cca
