// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/world/grid_paths.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace cca {
namespace {

struct Step {
  double cost = DistanceField::kUnreached;
  Cell from;
  bool settled = false;
};

struct OpenCell {
  double estimate;
  std::uint64_t order;  // first come, first served: the result does not depend on the heap
  Cell cell;
};
bool operator<(const OpenCell& a, const OpenCell& b) {
  return a.estimate != b.estimate ? a.estimate > b.estimate : a.order > b.order;
}

double octile(Cell a, Cell b) {
  const int dx = std::abs(a.x - b.x), dy = std::abs(a.y - b.y);
  return std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
}

using Path = std::vector<Eigen::Vector2d>;  // in cells

/// A* over cells, no cutting of corners, in the blocks of the coarse path and those beside them.
/// @return the middles of the cells from start to goal, empty where there is no path.
Path cellPath(const PassableSpace& space, const std::vector<Cell>& blocks, Cell start, Cell goal) {
  TiledGrid<char> corridor{0};
  for (const Cell b : blocks) {
    corridor[b] = 1;
    for (const Cell step : kNeighbours) corridor[b + step] = 1;
  }
  TiledGrid<Step> steps;
  std::priority_queue<OpenCell> open;
  std::uint64_t order = 0;
  steps[start] = {0.0, start, false};
  open.push({octile(start, goal), order++, start});
  while (!open.empty()) {
    const Cell c = open.top().cell;
    open.pop();
    Step& step = steps[c];
    if (step.settled) continue;
    step.settled = true;
    if (c == goal) break;
    const double cost = step.cost;
    for (std::size_t d = 0; d < kNeighbours.size(); ++d) {
      const Cell move = kNeighbours[d], next = c + move;
      if (!space.isTraversable(next) || !corridor.at(FreeSpace::blockOf(next))) continue;
      if (d >= 4 && (!space.isTraversable(c + Cell{move.x, 0}) ||
                     !space.isTraversable(c + Cell{0, move.y}))) {
        continue;
      }
      const double reached = cost + (d >= 4 ? std::sqrt(2.0) : 1.0);
      Step& beside = steps[next];
      if (beside.settled || beside.cost <= reached) continue;
      beside = {reached, c, false};
      open.push({reached + octile(next, goal), order++, next});
    }
  }
  Path path;
  if (!steps.at(goal).settled) return path;
  for (Cell c = goal; c != start; c = steps.at(c).from) path.push_back(middleOf(c));
  path.push_back(middleOf(start));
  std::reverse(path.begin(), path.end());
  return path;
}

/// String pulling: of each kept point, the farthest later one that lies in a clear line. The
/// farthest is found by doubling and halving steps: O(n log n) lines rather than O(n^2).
Path pulled(const PassableSpace& space, const Path& path) {
  Path kept{path.front()};
  for (std::size_t i = 0; i + 1 < path.size();) {
    std::size_t best = i + 1;
    for (std::size_t step = 1; step > 0;) {
      const std::size_t next = std::min(best + step, path.size() - 1);
      if (next > best && isClearLine(space, path[i], path[next])) {
        best = next;
        step *= 2;
      } else {
        step /= 2;
      }
    }
    kept.push_back(path[best]);
    i = best;
  }
  return kept;
}

}  // namespace

bool nearestTraversable(const PassableSpace& space, Cell c, int reach, Cell& found) {
  for (int ring = 0; ring <= reach; ++ring) {
    double nearest = DistanceField::kUnreached;
    for (int dy = -ring; dy <= ring; ++dy) {
      for (int dx = -ring; dx <= ring; ++dx) {
        if (std::max(std::abs(dx), std::abs(dy)) != ring) continue;
        const double distance = std::hypot(dx, dy);
        if (distance >= nearest || !space.isTraversable(c + Cell{dx, dy})) continue;
        nearest = distance;
        found = c + Cell{dx, dy};
      }
    }
    if (nearest < DistanceField::kUnreached) return true;
  }
  return false;
}

bool isClearLine(const PassableSpace& space, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double length = (b - a).norm();
  const Eigen::Vector2d direction =
      length > 0.0 ? Eigen::Vector2d((b - a) / length) : Eigen::Vector2d(1.0, 0.0);
  bool clear = true;
  Cell last, before_last;
  double last_entered = -1.0;
  walkBeam(a, direction, length, [&](Cell c, double entered) {
    clear = space.isTraversable(c);
    // Through a corner of cells: the cell on the other side of it counts too.
    if (clear && entered - last_entered < 1e-6 && entered > 1e-6) {
      clear = space.isTraversable(before_last + c + Cell{-last.x, -last.y});
    }
    before_last = last;
    last = c;
    last_entered = entered;
    return clear;
  });
  return clear;
}

std::vector<Eigen::Vector2d> shortestPath(const PassableSpace& space, double resolution,
                                          const DistanceField& field, Cell goal) {
  const std::vector<Cell> blocks = field.blocksTo(goal);
  if (blocks.empty()) return {};
  Path cells = cellPath(space, blocks, field.start(), goal);
  if (cells.empty()) return {};
  Path path = pulled(space, cells);
  std::reverse(cells.begin(), cells.end());
  Path backwards = pulled(space, cells);
  std::reverse(backwards.begin(), backwards.end());
  if (pathLength(backwards) < pathLength(path)) path = std::move(backwards);
  for (Eigen::Vector2d& corner : path) corner *= resolution;
  return path;
}

double pathLength(const std::vector<Eigen::Vector2d>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace cca
