// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/tangent_bug/tangent_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kSlide = 0.01;  // m, how much deeper a slide along a disc may lead

// The radius of a disc as seen from a place at this distance from its centre.
double discRadius(double radius, double distance) {
  return distance >= radius ? radius : std::max(0.0, distance - kSlide);
}

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

double ConfigurationSpace::freeDistance(const Eigen::Vector2d& from,
                                        const Eigen::Vector2d& direction, double longest) const {
  double free = longest;
  for (const Eigen::Vector2d& p : obstacles) {
    const Eigen::Vector2d to = p - from;
    const double ahead = to.dot(direction);
    if (ahead <= 0.0 || ahead - radius >= free) continue;
    const double squared = to.squaredNorm();
    const double disc = squared < radius * radius ? discRadius(radius, std::sqrt(squared)) : radius;
    const double inside = disc * disc - (squared - ahead * ahead);
    if (inside > 0.0) free = std::min(free, std::max(0.0, ahead - std::sqrt(inside)));
  }
  return free;
}

std::vector<FreeRange> ConfigurationSpace::freeRanges(
    const Eigen::Vector2d& from, const std::vector<Eigen::Vector2d>& directions,
    double longest) const {
  std::vector<FreeRange> ranges(directions.size(), {longest, -1});
  const int count = static_cast<int>(directions.size());
  const double step = 2.0 * M_PI / count;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Eigen::Vector2d to = obstacles[i] - from;
    const double distance = to.norm();
    const double disc = discRadius(radius, distance);
    if (distance - disc >= longest || disc == 0.0) continue;
    const double bearing = std::atan2(to.y(), to.x());
    const double half = std::asin(disc / distance);
    const int last = static_cast<int>(std::floor((bearing + half) / step));
    for (int k = static_cast<int>(std::ceil((bearing - half) / step)); k <= last; ++k) {
      const auto bearing_index = static_cast<std::size_t>((k % count + count) % count);
      FreeRange& range = ranges[bearing_index];
      if (range.distance < distance - disc) continue;  // nearer than the whole disc
      const Eigen::Vector2d& direction = directions[bearing_index];
      const double aside = cross(direction, to);
      const double inside = disc * disc - aside * aside;
      if (inside < 0.0) continue;
      const double free = std::max(0.0, direction.dot(to) - std::sqrt(inside));
      if (free < range.distance) range = {free, static_cast<int>(i)};
    }
  }
  return ranges;
}

bool ConfigurationSpace::isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const double length = (to - from).norm();
  return length == 0.0 || freeDistance(from, (to - from) / length, length) >= length;
}

double ConfigurationSpace::clearance(const Eigen::Vector2d& p_map) const {
  double squared = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& p : obstacles) squared = std::min(squared, (p - p_map).squaredNorm());
  return std::sqrt(squared);
}

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
