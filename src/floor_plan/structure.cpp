// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/floor_plan/structure.hpp"

#include <algorithm>

namespace cca {
namespace {

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
  part.origin = grid.inMetres({low.x, low.y});
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
  const std::vector<double> longest = longestLines(parts, lines), extent = extents(parts);
  const int outside = parts.labels.at({0, 0}, -1);
  Structure found{grid.alike(std::uint8_t{0}), grid.alike(std::uint8_t{0}),
                  grid.alike(std::uint8_t{0})};
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    const int label = parts.labels.values[k];
    const auto part = static_cast<std::size_t>(label);
    const bool is_small = label >= 0 && label != outside &&
                          (extent[part] <= tuning.pillar ||
                           (extent[part] <= tuning.group && longest[part] < tuning.pillar));
    found.open.values[k] = label < 0;
    found.furniture.values[k] = is_small;
    found.solid.values[k] = label >= 0 && !is_small;
  }
  return found;
}

}  // namespace cca
