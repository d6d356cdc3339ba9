// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/structure.hpp"

#include <algorithm>
#include <set>

#include "floor_plan/distance_transform.hpp"

namespace cca {
namespace {

constexpr double kBeyondWall = 0.15;  // m; lines end that much beyond their wall
constexpr double kDepth = 0.04;       // m inside of a wall's face, where its line is followed
constexpr double kOpposite =
    0.5;  // cosine; walls on two sides run to 60 degrees against each other
constexpr double kIntoCorner = 1.42;  // a disc's radius to the corner that it fits into

/// m, the longest line of each component.
std::vector<double> longestLines(const Components& parts, const std::vector<MapLine>& lines) {
  std::vector<double> longest(parts.sizes.size(), 0.0);
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    const double length = s.length();
    for (const Cell c : cellsAlong(parts.labels, s.start, s.end)) {
      double& known = longest[static_cast<std::size_t>(parts.labels[c])];
      known = std::max(known, length);
    }
  }
  return longest;
}

/// m, the longer side of each component's box.
std::vector<double> extents(const Components& parts) {
  std::vector<double> extent;
  for (std::size_t k = 0; k < parts.sizes.size(); ++k) {
    const Cell low = parts.lowest[k], high = parts.highest[k];
    extent.push_back(parts.labels.resolution * (1 + std::max(high.x - low.x, high.y - low.y)));
  }
  return extent;
}

/// The islands that a wall's line meets beyond its end, before it meets the building again.
std::set<std::size_t> metBeyond(const Components& parts, const std::vector<char>& is_island,
                                const Eigen::Vector2d& end, const Eigen::Vector2d& direction,
                                double farthest) {
  const double step = 0.5 * parts.labels.resolution;
  std::set<std::size_t> met;
  bool has_left_wall = false;
  for (double s = -kBeyondWall; s <= farthest; s += step) {
    const int label = parts.labels.at(parts.labels.cellOf(end + s * direction), -1);
    const auto part = static_cast<std::size_t>(label);
    const bool is_building = label >= 0 && !is_island[part];
    if (is_building && has_left_wall) break;
    has_left_wall = has_left_wall || !is_building;
    if (label >= 0 && !is_building) met.insert(part);
  }
  return met;
}

/// Islands that walls lead up to from two sides.
std::vector<char> betweenWalls(const Components& parts, const std::vector<char>& is_island,
                               const std::vector<MapLine>& lines, const StructureTuning& tuning) {
  std::vector<std::vector<Eigen::Vector2d>> met(parts.sizes.size());
  std::vector<char> is_between(parts.sizes.size(), 0);
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    if (s.length() < tuning.pillar) continue;
    const Eigen::Vector2d along = s.direction(), into_wall(along.y(), -along.x());
    for (const bool at_end : {false, true}) {
      const Eigen::Vector2d direction = at_end ? along : Eigen::Vector2d(-along);
      const Eigen::Vector2d end = (at_end ? s.end : s.start) + kDepth * into_wall;
      for (const std::size_t k : metBeyond(parts, is_island, end, direction, tuning.farthest)) {
        for (const Eigen::Vector2d& other : met[k])
          is_between[k] = is_between[k] || other.dot(direction) < -kOpposite;
        met[k].push_back(direction);
      }
    }
  }
  return is_between;
}

/// What stands free and is no part of the building, by component.
std::vector<char> furnitureAmong(const Components& parts, const std::vector<MapLine>& lines,
                                 const StructureTuning& tuning) {
  const std::vector<double> longest = longestLines(parts, lines), extent = extents(parts);
  const int outside = parts.labels.at({0, 0}, -1);
  std::vector<char> is_island(parts.sizes.size(), 0);
  for (std::size_t k = 0; k < is_island.size(); ++k) {
    is_island[k] =
        static_cast<int>(k) != outside &&
        (extent[k] <= tuning.pillar || (extent[k] <= tuning.group && longest[k] < tuning.pillar));
  }
  const std::vector<char> is_between = betweenWalls(parts, is_island, lines, tuning);
  std::vector<char> is_furniture = is_island;
  for (std::size_t k = 0; k < is_island.size(); ++k) {
    const bool is_pillar = extent[k] >= tuning.thinnest_pillar && extent[k] <= tuning.pillar;
    if (is_between[k] && is_pillar) is_furniture[k] = 0;
  }
  return is_furniture;
}

}  // namespace

bool standsOn(const Mask& solid, const LineSegment& line) {
  const std::vector<Cell> cells = cellsAlong(solid, line.start, line.end);
  const auto on = std::count_if(cells.begin(), cells.end(), [&](Cell c) { return solid[c] != 0; });
  return 2 * static_cast<std::size_t>(on) > cells.size();
}

OccupancyRaster cropToKnown(const OccupancyRaster& grid, int margin_cells) {
  Cell low{grid.columns, grid.rows}, high{-1, -1};
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    if (grid.values[k] == Occupancy::kUnknown) continue;
    const Cell c = grid.cell(k);
    low = {std::min(low.x, c.x), std::min(low.y, c.y)};
    high = {std::max(high.x, c.x), std::max(high.y, c.y)};
  }
  OccupancyRaster part;
  part.resolution = grid.resolution;
  if (high.x < 0) return part;
  low = low + Cell{-margin_cells, -margin_cells};
  high = high + Cell{margin_cells, margin_cells};
  part.columns = high.x - low.x + 1;
  part.rows = high.y - low.y + 1;
  // To a micrometre, as map.yaml has it: the same cells, however they were cut out, give one plan.
  part.origin = (1e6 * grid.inMetres({low.x, low.y})).array().round() / 1e6;
  part.values.reserve(static_cast<std::size_t>(part.columns) * static_cast<std::size_t>(part.rows));
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x)
      part.values.push_back(grid.at({x, y}, Occupancy::kUnknown));
  }
  return part;
}

Structure tellStructure(const OccupancyRaster& grid, const std::vector<MapLine>& lines,
                        const StructureTuning& tuning) {
  Mask blocked = grid.alike(std::uint8_t{0});
  for (std::size_t k = 0; k < grid.values.size(); ++k)
    blocked.values[k] = grid.values[k] != Occupancy::kFree;
  for (const MapLine& line : lines) {
    for (const Cell c : cellsAlong(blocked, line.segment.start, line.segment.end)) blocked[c] = 1;
  }
  const Components parts = connectedComponents(blocked, 8);
  const std::vector<char> is_furniture = furnitureAmong(parts, lines, tuning);
  Structure found{grid.alike(std::uint8_t{0}), grid.alike(std::uint8_t{0}),
                  grid.alike(std::uint8_t{0})};
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    const int label = parts.labels.values[k];
    const bool is_small = label >= 0 && is_furniture[static_cast<std::size_t>(label)];
    found.open.values[k] = label < 0;
    found.furniture.values[k] = is_small;
    found.solid.values[k] = label >= 0 && !is_small;
  }
  return found;
}

Mask spaceForRooms(const Structure& structure, const Raster<float>& clearance,
                   const StructureTuning& tuning) {
  Mask wide = structure.solid.alike(std::uint8_t{0});
  for (std::size_t k = 0; k < wide.values.size(); ++k)
    wide.values[k] = clearance.values[k] >= tuning.half_slit;
  const Raster<float> beside = distanceTransform(wide);
  const double reach = kIntoCorner * tuning.half_slit + wide.resolution;
  Mask space = structure.solid.alike(std::uint8_t{0});
  for (std::size_t k = 0; k < space.values.size(); ++k)
    space.values[k] = structure.solid.values[k] == 0 && beside.values[k] <= reach;
  return space;
}

}  // namespace cca
