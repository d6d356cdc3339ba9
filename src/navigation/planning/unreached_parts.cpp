// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/unreached_parts.hpp"

#include <algorithm>
#include <utility>

namespace cca {
namespace {

constexpr double kLeastPart = 0.25;  // m^2, a robot of half a metre

using Cells = std::vector<Cell>;

CellSet unreachedCells(const PlanningScene& scene) {
  CellSet cells;
  const Cell low = FreeSpace::blockOf(scene.grid().lowest()),
             high = FreeSpace::blockOf(scene.grid().highest());
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      FreeSpace::eachCell({x, y}, scene.space().traversableCells({x, y}), [&](Cell c) {
        if (!scene.distances().isReached(c)) cells.insert(c);
      });
    }
  }
  return cells;
}

/// Cells that are connected with each other, by all eight neighbours.
std::vector<Cells> connected(const CellSet& all) {
  TiledGrid<char> is_taken{0};
  std::vector<Cells> parts;
  for (const Cell first : all.cells()) {
    if (is_taken.at(first)) continue;
    is_taken[first] = 1;
    Cells part{first};
    for (std::size_t next = 0; next < part.size(); ++next) {
      for (const Cell step : kNeighbours) {
        const Cell c = part[next] + step;
        if (!all.contains(c) || is_taken.at(c)) continue;
        is_taken[c] = 1;
        part.push_back(c);
      }
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

Cell cellInTheMiddle(const Cells& cells) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Cell c : cells) mean += middleOf(c) / static_cast<double>(cells.size());
  return *std::min_element(cells.begin(), cells.end(), [&](Cell a, Cell b) {
    return (middleOf(a) - mean).squaredNorm() < (middleOf(b) - mean).squaredNorm();
  });
}

/// Where the centre of a disc may be that keeps nothing beyond its radius, and nothing is blocked.
FreeSpace spaceOf(const ExplorationGrid& grid, double radius) {
  const double side = grid.resolution();
  FreeSpace space(std::max(0.0, radius - ExplorationGrid::kBehindSurface * side), side);
  Cells known;
  for (int y = grid.lowest().y; y <= grid.highest().y; ++y) {
    for (int x = grid.lowest().x; x <= grid.highest().x; ++x) {
      if (grid.at({x, y}) != CellState::kUnknown) known.push_back({x, y});
    }
  }
  space.update(grid, known);
  return space;
}

}  // namespace

std::vector<UnreachedPart> unreachedParts(const PlanningScene& scene,
                                          const Eigen::Vector2d& robot_map, double radius) {
  const ExplorationGrid& grid = scene.grid();
  const double square = grid.resolution() * grid.resolution();
  std::vector<UnreachedPart> parts;
  std::vector<Cells> cells = connected(unreachedCells(scene));
  const auto is_small = [&](const Cells& part) {
    return static_cast<double>(part.size()) * square < kLeastPart;
  };
  cells.erase(std::remove_if(cells.begin(), cells.end(), is_small), cells.end());
  if (cells.empty() || !grid.covers(robot_map)) return parts;
  DistanceField ways;
  ways.search(spaceOf(grid, radius), grid.resolution(), grid.cellOf(robot_map));
  for (const Cells& part : cells) {
    const Cell middle = cellInTheMiddle(part);
    parts.push_back(
        {static_cast<double>(part.size()) * square, grid.centreOf(middle), ways.isReached(middle)});
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const UnreachedPart& a, const UnreachedPart& b) { return a.area > b.area; });
  return parts;
}

}  // namespace cca
