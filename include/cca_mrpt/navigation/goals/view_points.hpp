// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/navigation/place/exploration_grid.hpp"
#include "cca_mrpt/navigation/place/frontier.hpp"
#include "cca_mrpt/navigation/place/grid_paths.hpp"
#include "cca_mrpt/navigation/place/known_place.hpp"

namespace cca {

/// A place to look from, and what is expected to be seen.
struct ViewPoint {
  Cell cell;              ///< traversable and reached
  Cell target;            ///< the unknown cell that it is there to see
  double distance = 0.0;  ///< m, of the way there
  double gain = 0.0;      ///< m^2 of unknown area in view if all of it were free
  double expected = 0.0;  ///< m^2 of it that will be seen, as viewFrom() expects
};

/// A cell behind the middle of a frontier, up to `depth` metres into the unknown: what one wants to
/// see, where the frontier itself is in view already. Never beyond what is known.
Cell cellBehind(const ExplorationGrid& grid, const Frontier& frontier, double depth);

/// Whether a cell will be seen from a known one: nothing known to be an obstacle stands between
/// them, and the line ends in no more than kThroughUnknown of the unknown, where walls are.
bool isInView(const ExplorationGrid& grid, Cell from, Cell to);

/// m. With 1 to 2.1 m the robot drives the same; without end, 5 % farther to 99 % coverage.
inline constexpr double kThroughUnknown = 1.5;

/// Visits the blocks of FreeSpace in view from a cell, by rays as those of viewFrom: each once for
/// every ray through it. Cost: O(range / resolution) for each ray.
void eachBlockInView(const ExplorationGrid& grid, Cell from, double range,
                     const std::function<void(Cell block)>& visit);

/// The place of the shortest way from which a cell is in free view, not among the scanned ones.
///
/// 90 rays go out from the cell and end at occupied cells and presumed walls.
/// @param range  m, how far off it may be.
/// @return       empty where no reached place sees the cell. Cost: O(range / resolution).
std::optional<ViewPoint> nearestViewPoint(const ExplorationGrid& grid, const FreeSpace& space,
                                          const DistanceField& field, const ScannedPlaces& scanned,
                                          Cell target, double range);

/// m^2: the unknown area in view from a cell if all unknown cells were free [Gonzalez-Banos &
/// Latombe 2002]: 72 rays end at occupied cells and presumed walls.
double unknownAreaInView(const ExplorationGrid& grid, Cell from, double range);

/// What a place (a known cell) is good for: like unknownAreaInView, by 360 rays, as fine as a
/// laser's beams, that may cut the corners of opaque cells (one cell's length in all).
///
/// Of a stretch of u metres of the unknown, a ray is expected to see (1 - exp(-2 u)) / 2: it ends
/// there after half a metre on average. In furnished buildings a rest shows some 0.25 m^2, whether
/// the area in view is 0.3 or 3 m^2; a gap into a room shows what its width lets through.
/// @param openings  what lies behind these cells counts.
/// @return the place with its gain and what is expected of it, no distance; the target is the
///         middle of the longest unknown stretch, or the place itself where nothing unknown is in
///         view. Cost: O(openings), and O(range / resolution) for each ray that meets one.
ViewPoint viewFrom(const ExplorationGrid& grid, Cell from, double range, const CellSet& openings);

/// How the next goal is chosen, among view points with their way and gain.
enum class Strategy {
  kGreedy,           ///< the largest gain: the paper's Step 0
  kNearestFrontier,  ///< the shortest way [Yamauchi 1997]
  kGainDistance,     ///< gain exp(-0.2 way) [Gonzalez-Banos & Latombe 2002]
  /// The most expected information per metre of way, after [Amigoni & Caglioti 2010].
  /// Deviation: the information is the unknown area in view alone; theirs adds the re-sensing of
  /// known boundaries, which is nothing to a robot whose pose is known.
  kInformation,
  kViewTour,  ///< a frontier that promises much, else the first stop of a tour, see ViewTour
};

/// As options and files name them.
inline constexpr std::pair<const char*, Strategy> kStrategyNames[] = {
    {"view_tour", Strategy::kViewTour},
    {"greedy", Strategy::kGreedy},
    {"nearest_frontier", Strategy::kNearestFrontier},
    {"gain_distance", Strategy::kGainDistance},
    {"information", Strategy::kInformation}};

/// m^2, gain exp(-0.2 way) [Gonzalez-Banos & Latombe 2002].
double discountedGain(const ViewPoint& view_point);

/// @throws std::runtime_error for a name that is none.
Strategy strategyNamed(const std::string& name);

/// The best view point by itself, for all strategies but kViewTour, which looks at all of them.
///
/// @return  its index; the first of equals; empty for no view points.
std::optional<std::size_t> selectGoal(Strategy strategy, const std::vector<ViewPoint>& view_points);

}  // namespace cca
