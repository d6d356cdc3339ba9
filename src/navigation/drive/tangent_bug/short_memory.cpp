// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/short_memory.hpp"

#include <algorithm>

namespace cca {

void ShortMemory::update(const LocalView& before, const LocalView& now, double time) {
  const Eigen::Vector2d x = now.T_map_robot.position();
  points_.erase(std::remove_if(points_.begin(), points_.end(),
                               [&](const Point& point) {
                                 return time - point.time > kAge ||
                                        (point.p_map - x).norm() > kReach ||
                                        now.inFieldOfView(point.p_map);
                               }),
                points_.end());
  for (const Eigen::Vector2d& p_map : before.obstacles) {
    if (now.inFieldOfView(p_map) || !before.inFieldOfView(p_map)) continue;
    if ((p_map - x).norm() <= kReach) points_.push_back({p_map, time});
  }
}

std::vector<Eigen::Vector2d> ShortMemory::points() const {
  std::vector<Eigen::Vector2d> points;
  for (const Point& point : points_) points.push_back(point.p_map);
  return points;
}

}  // namespace cca
