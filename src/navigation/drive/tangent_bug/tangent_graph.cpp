// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/tangent_graph.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

// A chord of this arc dents a disc of 0.3 m by 18 mm.
constexpr double kDetour = 40.0 * M_PI / 180.0;

Eigen::Vector2d onCircle(const Eigen::Vector2d& center, double radius, double angle) {
  return center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

// Whether the free distance jumps up from a to b.
bool jumps(const LocalView& view, const ConfigurationSpace& space, const FreeRange& a,
           const FreeRange& b) {
  if (a.obstacle < 0 || a.obstacle == b.obstacle || b.distance <= a.distance) return false;
  if (b.obstacle < 0) return true;
  const Eigen::Vector2d apart = space.obstacles[static_cast<std::size_t>(a.obstacle)] -
                                space.obstacles[static_cast<std::size_t>(b.obstacle)];
  return apart.norm() > 2.0 * space.radius && !view.onOneSurface(a.obstacle, b.obstacle);
}

}  // namespace

std::vector<TangentNode> localTangentGraph(const LocalView& view, const ConfigurationSpace& space,
                                           const std::vector<FreeRange>& ranges, double radius) {
  const Eigen::Vector2d x_map = view.T_map_robot.position();
  std::vector<TangentNode> nodes;
  const auto addNode = [&](int obstacle, bool free_on_the_left) {
    // Between two bearings a wall that is grazed goes on to its end, unless a corner hides that.
    for (int edge : {view.surfaceEnd(obstacle, free_on_the_left), obstacle}) {
      const Eigen::Vector2d& edge_map = space.obstacles[static_cast<std::size_t>(edge)];
      const Eigen::Vector2d back = x_map - edge_map;
      const double distance = back.norm();
      // With the obstacle on its right, the robot goes around it clockwise.
      const double turn = free_on_the_left ? -1.0 : 1.0;
      const double opening = distance > radius ? std::acos(radius / distance) : 0.0;
      const double tangent = std::atan2(back.y(), back.x()) + turn * opening;
      for (double around : {kDetour, 0.5 * kDetour, 0.0}) {
        const Eigen::Vector2d node = onCircle(edge_map, radius, tangent + turn * around);
        if (!space.isFree(x_map, node)) continue;
        nodes.push_back({node, edge_map, free_on_the_left});
        return;
      }
    }
  };
  const std::size_t n = ranges.size();
  for (std::size_t k = 0; k < n; ++k) {
    const FreeRange &a = ranges[k], &b = ranges[(k + 1) % n];
    if (jumps(view, space, a, b)) addNode(a.obstacle, true);
    if (jumps(view, space, b, a)) addNode(b.obstacle, false);
  }
  return nodes;
}

}  // namespace cca
