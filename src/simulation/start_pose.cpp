// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <queue>
#include <stdexcept>

#include "cca_mrpt/simulation/world.hpp"

namespace cca {

namespace {

/// Steps to the nearest obstacle cell, by a brush fire over the eight neighbours.
std::vector<int> brushFire(const World& world) {
  const int width = world.width(), height = world.height();
  std::vector<int> steps(static_cast<std::size_t>(width) * height, -1);
  std::queue<std::pair<int, int>> fire;
  for (int iy = 0; iy < height; ++iy) {
    for (int ix = 0; ix < width; ++ix) {
      if (!world.isObstacle(ix, iy)) continue;
      steps[static_cast<std::size_t>(iy) * width + ix] = 0;
      fire.emplace(ix, iy);
    }
  }
  while (!fire.empty()) {
    const auto [ix, iy] = fire.front();
    fire.pop();
    const int here = steps[static_cast<std::size_t>(iy) * width + ix];
    for (int y = std::max(iy - 1, 0); y <= std::min(iy + 1, height - 1); ++y) {
      for (int x = std::max(ix - 1, 0); x <= std::min(ix + 1, width - 1); ++x) {
        int& there = steps[static_cast<std::size_t>(y) * width + x];
        if (there >= 0) continue;
        there = here + 1;
        fire.emplace(x, y);
      }
    }
  }
  return steps;
}

/// The largest of the connected regions of the cells that are `least` steps from all obstacles.
std::vector<std::size_t> largestRegion(const World& world, const std::vector<int>& steps,
                                       double least) {
  const int width = world.width(), height = world.height();
  std::vector<bool> is_taken(steps.size(), false);
  std::vector<std::size_t> largest, region;
  for (std::size_t first = 0; first < steps.size(); ++first) {
    if (is_taken[first] || steps[first] < least) continue;
    region.assign(1, first);
    is_taken[first] = true;
    for (std::size_t next = 0; next < region.size(); ++next) {
      const int ix = static_cast<int>(region[next]) % width;
      const int iy = static_cast<int>(region[next]) / width;
      for (int y = std::max(iy - 1, 0); y <= std::min(iy + 1, height - 1); ++y) {
        for (int x = std::max(ix - 1, 0); x <= std::min(ix + 1, width - 1); ++x) {
          const std::size_t there = static_cast<std::size_t>(y) * width + x;
          if (is_taken[there] || steps[there] < least) continue;
          is_taken[there] = true;
          region.push_back(there);
        }
      }
    }
    if (region.size() > largest.size()) largest = region;
  }
  return largest;
}

}  // namespace

Pose2 defaultStart(const World& world, double radius) {
  if (world.start) return *world.start;
  const std::vector<int> steps = brushFire(world);
  // An obstacle so many steps away begins half a cell nearer.
  std::vector<std::size_t> region =
      largestRegion(world, steps, std::max(1.0, radius / world.resolution() + 0.5));
  if (region.empty()) {
    region.resize(steps.size());
    std::iota(region.begin(), region.end(), std::size_t{0});
  }
  std::sort(region.begin(), region.end());
  const auto widest = static_cast<int>(
      *std::max_element(region.begin(), region.end(),
                        [&](std::size_t a, std::size_t b) { return steps[a] < steps[b]; }));
  const Eigen::Vector2d p =
      world.origin() +
      world.resolution() * Eigen::Vector2d(static_cast<double>(widest % world.width()) + 0.5,
                                           static_cast<double>(widest / world.width()) + 0.5);
  if (world.clearance(p, radius) < radius) {
    char text[160];
    std::snprintf(text, sizeof text, ": no place is free enough for a robot of radius %.3g m",
                  radius);
    throw std::runtime_error(world.name + text);
  }
  return {p.x(), p.y(), 0.0};
}

void requireStandable(const World& world, const Pose2& T_map_robot, double radius) {
  const double clearance = world.clearance(T_map_robot.position(), radius);
  if (clearance >= radius) return;
  const Eigen::Vector2d cell = world.toCells(T_map_robot.position());
  const bool inside =
      cell.x() >= 0 && cell.y() >= 0 && cell.x() < world.width() && cell.y() < world.height();
  char text[240];
  std::snprintf(text, sizeof text,
                ": start %.3f, %.3f m %s (clearance %.3f m, needed %.3f m); the world spans x %.2f "
                "to %.2f, y %.2f to %.2f m",
                T_map_robot.x, T_map_robot.y,
                inside ? "touches an obstacle" : "lies outside the world", clearance, radius,
                world.origin().x(), world.origin().x() + world.width() * world.resolution(),
                world.origin().y(), world.origin().y() + world.height() * world.resolution());
  throw std::runtime_error(world.name + text);
}

}  // namespace cca
