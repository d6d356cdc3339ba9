// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "cca_mrpt/navigation/explorer_parameters.hpp"
#include "navigation/planning/planning_scene.hpp"

namespace cca {

/// A place to look from, and what is expected to be seen.
struct ViewPoint {
  Cell cell;              ///< traversable and reached
  Cell target;            ///< the unknown cell that it is there to see
  double distance = 0.0;  ///< m, of the way there
  double gain = 0.0;      ///< m^2 of unknown area in view if all of it were free
  double expected = 0.0;  ///< m^2 of it that will be seen, as viewFrom() expects
};

/// Whether a cell within range (m) will be seen from a known one: nothing known to be an obstacle
/// stands between them, and the line ends in no more than kThroughUnknown of the unknown, where
/// walls are.
bool isInView(const ExplorationGrid& grid, Cell from, Cell to, double range);

/// m: of rays that get a metre into the unknown on average (see ViewPoint), a fifth get farther.
inline constexpr double kThroughUnknown = 1.5;
/// m, that any look costs: ways are measured in blocks of this size.
inline constexpr double kShortestWay = 0.2;

/// What a place (a known cell) is good for. The gain is the unknown area in view if all unknown
/// cells were free [Gonzalez-Banos & Latombe 2002]: 360 rays, as fine as a laser's beams, end at
/// occupied cells and presumed walls, but may cut their corners (one cell's length in all).
///
/// Of a stretch of u metres of the unknown, a ray is expected to see 1 - exp(-u): it ends there
/// after a metre on average.
/// @param frontier_cells  what lies behind these cells counts.
/// @return the place with its gain and what is expected of it, no distance; the target is the
///         middle of the longest unknown stretch; the place
///         itself where nothing unknown is in view. Cost: O(frontier_cells), and O(range /
///         resolution) for each ray that meets one.
ViewPoint viewFrom(const ExplorationGrid& grid, Cell from, double range,
                   const CellSet& frontier_cells);

/// How good a view point is by a strategy: the more, the better.
double scoreOf(Strategy strategy, const ViewPoint& view_point);

/// Where the robot would cross the frontiers, with what is in view from there: what the strategies
/// of others choose among. Left out are places that the robot does not reach or has looked around
/// at, and frontiers that are small, promise little or are blacklisted. Cost: O(frontier cells),
/// and a look for each frontier.
std::vector<ViewPoint> frontierPlaces(const PlanningScene& scene, std::size_t smallest_frontier,
                                      double smallest_gain);

}  // namespace cca
