// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <vector>

#include "navigation/control/tangent_bug/boundary_follower.hpp"
#include "traps.hpp"

namespace cca::testing {

/// The obstacles' outlines, sampled every 10 cm, grown by `radius`.
inline ConfigurationSpace sampledSpace(const BoxWorld& world, double radius) {
  ConfigurationSpace space;
  space.radius = radius;
  for (const Box& box : world.boxes) {
    for (int axis = 0; axis < 2; ++axis) {
      const int other = 1 - axis;
      const double length = box.high[axis] - box.low[axis];
      const int pieces = std::max(1, static_cast<int>(std::ceil(length / 0.1)));
      for (int i = 0; i <= pieces; ++i) {
        for (double side : {box.low[other], box.high[other]}) {
          Eigen::Vector2d p;
          p[axis] = box.low[axis] + length * i / pieces;
          p[other] = side;
          space.obstacles.push_back(p);
        }
      }
    }
  }
  return space;
}

/// The bound of Kamon, Rimon & Rivlin on Tangent Bug's path,
///   |S T| + sum over obstacles (1 + number of minima of d(., T) on the boundary) * perimeter,
/// over the boundaries of the configuration space that come nearer to T than S is.
inline double tangentBugBound(const Trap& trap, double radius) {
  const ConfigurationSpace space = sampledSpace(trap.world, radius);
  const double direct = (trap.goal - trap.start.position()).norm();
  double bound = direct;
  std::vector<Eigen::Vector2d> walked;
  const auto always = [](const Eigen::Vector2d&) { return true; };
  for (const Eigen::Vector2d& p : space.obstacles) {
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d side(std::cos(k * M_PI_2), std::sin(k * M_PI_2));
      const Eigen::Vector2d start = p + radius * side;
      const bool outside = start.minCoeff() < 0.0 || start.maxCoeff() > trap.size;
      if (outside || trap.world.clearance(start) < radius - 1e-6) continue;
      const bool known = std::any_of(walked.begin(), walked.end(), [&](const auto& w) {
        return (w - start).squaredNorm() < 0.1 * 0.1;
      });
      if (known) continue;
      const auto trace = traceBoundary(space, start, true, 500.0, always);
      std::size_t end = 1;  // where the loop closes
      while (end < trace.size() && (trace[end].length < 1.0 ||
                                    (trace[end].center_map - trace[0].center_map).norm() > 0.12)) {
        ++end;
      }
      double nearest = INFINITY;
      int minima = 0;
      bool falling = false;
      double low = INFINITY, high = 0.0;
      for (std::size_t i = 0; i < end; ++i) {
        walked.push_back(trace[i].center_map);
        const double d = (trace[i].center_map - trap.goal).norm();
        nearest = std::min(nearest, d);
        // Minima deeper than 2 cm: the sampled boundary is slightly wavy.
        if (d < high - 0.02 && !falling) falling = true, low = d;
        low = std::min(low, d);
        if (falling && d > low + 0.02) ++minima, falling = false, high = d;
        high = falling ? high : std::max(high, d);
      }
      if (nearest < direct) bound += (1 + minima) * trace[std::min(end, trace.size() - 1)].length;
    }
  }
  return bound;
}

/// The shortest way over a grid of 4 cm with 16 directions (at most 3 % too long); inf without any.
inline double shortestWay(const Trap& trap, double size, double radius) {
  constexpr double kCell = 0.04;
  const int n = static_cast<int>(size / kCell);
  const auto center = [&](int c, int r) {
    return Eigen::Vector2d((c + 0.5) * kCell, (r + 0.5) * kCell);
  };
  std::vector<double> cost(static_cast<std::size_t>(n * n), INFINITY);
  std::vector<char> free(cost.size());
  for (int i = 0; i < n * n; ++i) {
    free[static_cast<std::size_t>(i)] = trap.world.clearance(center(i % n, i / n)) >= radius;
  }
  using Node = std::pair<double, int>;
  std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
  const auto cell = [&](const Eigen::Vector2d& p) {
    return static_cast<int>(p.y() / kCell) * n + static_cast<int>(p.x() / kCell);
  };
  const int goal = cell(trap.goal);
  open.push({0.0, cell(trap.start.position())});
  cost[static_cast<std::size_t>(cell(trap.start.position()))] = 0.0;
  while (!open.empty()) {
    const auto [d, i] = open.top();
    open.pop();
    if (i == goal) return d;
    if (d > cost[static_cast<std::size_t>(i)]) continue;
    for (int dx = -2; dx <= 2; ++dx) {
      for (int dy = -2; dy <= 2; ++dy) {
        if (std::abs(dx) + std::abs(dy) == 0 || (std::abs(dx) != 1 && std::abs(dy) != 1)) continue;
        const int c = i % n + dx, r = i / n + dy;
        if (c < 0 || r < 0 || c >= n || r >= n) continue;
        const auto j = static_cast<std::size_t>(r * n + c);
        const double next = d + kCell * std::hypot(dx, dy);
        if (!free[j] || next >= cost[j]) continue;
        cost[j] = next;
        open.push({next, static_cast<int>(j)});
      }
    }
  }
  return INFINITY;
}

}  // namespace cca::testing
