// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cca {

World::World(std::string world_name, int width, int height,
             const std::vector<unsigned char>& obstacle, double resolution,
             const Eigen::Vector2d& origin)
    : name(std::move(world_name)),
      width_(width),
      height_(height),
      resolution_(resolution),
      origin_(origin),
      cells_(obstacle) {
  const float side = static_cast<float>(resolution);
  grid_.setSize(0.0f, width * side, 0.0f, height * side, side);
  for (int iy = 0; iy < height; ++iy) {
    for (int ix = 0; ix < width; ++ix) {
      auto& cell = cells_[static_cast<std::size_t>(iy) * width + ix];
      if (ix == 0 || iy == 0 || ix == width - 1 || iy == height - 1) cell = 1;
      grid_.setCell(ix, iy, cell ? 0.0f : 1.0f);
    }
  }
}

void World::seeFrom(const Eigen::Vector2d& p_frame) {
  origin_ -= p_frame;
  if (start) start = Pose2{start->x - p_frame.x(), start->y - p_frame.y(), start->theta};
}

double World::clearance(const Eigen::Vector2d& p_map, double limit) const {
  const Eigen::Vector2d p = toCells(p_map);
  // Asked so that what is no number is not inside, and no huge one becomes a cell's.
  if (!(p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= width_ && p.y() <= height_)) return 0.0;
  const double reach = limit / resolution_;
  const int x0 = static_cast<int>(std::floor(p.x() - reach)),
            x1 = static_cast<int>(std::floor(p.x() + reach)),
            y0 = static_cast<int>(std::floor(p.y() - reach)),
            y1 = static_cast<int>(std::floor(p.y() + reach));
  double best_sq = reach * reach;
  for (int iy = y0; iy <= y1; ++iy) {
    const double dy = std::max({iy - p.y(), 0.0, p.y() - (iy + 1)});
    if (dy * dy >= best_sq) continue;
    for (int ix = x0; ix <= x1; ++ix) {
      const double dx = std::max({ix - p.x(), 0.0, p.x() - (ix + 1)});
      const double gap_sq = dx * dx + dy * dy;
      if (gap_sq < best_sq && isObstacle(ix, iy)) best_sq = gap_sq;
    }
  }
  return std::sqrt(best_sq) * resolution_;
}

}  // namespace cca
