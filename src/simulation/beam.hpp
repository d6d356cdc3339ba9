// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "cca_mrpt/simulation/world.hpp"

namespace cca {

/// Walks along a beam from cell to cell (digital differential analyser, Amanatides & Woo 1987):
/// exact for the grid, free of bias.
/// @param bearing    rad, map frame.
/// @param max_range  m.
/// @param visit      called with the index (row * width + column) of each free cell entered, the
///                   first one too.
/// @return           m, distance to the edge of the first obstacle cell; +inf where none is met up
///                   to max_range; 0 from inside an obstacle, and then nothing is visited.
/// Cost: cells crossed.
template <class Visit>
double walkBeam(const World& world, const Eigen::Vector2d& p_map, double bearing, double max_range,
                Visit&& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d p = world.toCells(p_map);
  const int ix = static_cast<int>(std::floor(p.x())), iy = static_cast<int>(std::floor(p.y()));
  if (world.isObstacle(ix, iy)) return 0.0;
  const double dx = std::cos(bearing), dy = std::sin(bearing);
  const double reach = max_range / world.resolution();
  // Way between vertical (horizontal) cell edges, and to the first one.
  const double every_x = dx != 0.0 ? std::abs(1.0 / dx) : kNever;
  const double every_y = dy != 0.0 ? std::abs(1.0 / dy) : kNever;
  double next_x = dx != 0.0 ? (dx > 0.0 ? ix + 1 - p.x() : p.x() - ix) * every_x : kNever;
  double next_y = dy != 0.0 ? (dy > 0.0 ? iy + 1 - p.y() : p.y() - iy) * every_y : kNever;
  // The outermost cells are obstacles: a beam from a free cell never leaves the grid.
  const unsigned char* obstacle = world.obstacles().data();
  const int width = world.width(), step_x = dx > 0.0 ? 1 : -1, step_y = dy > 0.0 ? width : -width;
  int cell = iy * width + ix;
  for (;;) {
    visit(cell);
    double travelled;
    if (next_x < next_y) {
      travelled = next_x;
      next_x += every_x;
      cell += step_x;
    } else {
      travelled = next_y;
      next_y += every_y;
      cell += step_y;
    }
    if (travelled > reach) return kNever;
    if (obstacle[cell]) return travelled * world.resolution();
  }
}

}  // namespace cca
