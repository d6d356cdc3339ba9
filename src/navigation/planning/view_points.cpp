// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/view_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/cross.hpp"
#include "sensing/beam.hpp"

namespace cca {
namespace {

// m, that a ray gets in the unknown on average. With 0.5, and with 2 more in plain rooms, the robot
// drives some 3 % farther.
constexpr double kFreeWay = 1.0;

// m^2 for each metre of a wall's face that was not seen, across the view: so half a metre reaches
// the smallest gain. What is expected of it is less: at 0.2 the robot drives a quarter farther in
// apartments, halls and galleries; at 0.05 to 0.08 it leaves faces and crowded corners unseen.
constexpr double kFace = 0.2, kExpectedOfFace = 0.1;

constexpr int kCount = 360;  // rays, one a degree: as fine as the beams of a usual laser
/// Never along an axis: no ties at corners.
const std::vector<Eigen::Vector2d> kRays = directionsAround(kCount, M_PI / kCount);

bool isOpaque(CellState state) {
  return state == CellState::kPresumedWall || state == CellState::kOccupied;
}

/// Follows a ray to where it has gone through more opaque cells than a surface may lie before their
/// middles: a ray before the surface may cut a cell's corner.
/// @param visit  void(Cell, CellState, double entered): for each cell, see walkBeam.
/// @return the ray's length, in cells.
template <class Visit>
double followRay(const ExplorationGrid& grid, Cell from, const Eigen::Vector2d& direction,
                 double reach, Visit&& visit) {
  double end = reach, opaque = 0.0, opaque_since = -1.0;
  walkBeam(middleOf(from), direction, reach, [&](Cell c, double entered) {
    if (opaque_since >= 0.0) {
      opaque += entered - opaque_since;
      if (opaque > ExplorationGrid::kBehindSurface) {
        end = opaque_since;
        return false;
      }
      opaque_since = -1.0;
    }
    const CellState state = grid.at(c);
    visit(c, state, entered);
    if (isOpaque(state)) opaque_since = entered;
    return true;
  });
  return end;
}

/// The side of a cell that a neighbour is on; kNeighbours' order.
std::size_t sideOf(Cell c, Cell neighbour) {
  if (neighbour.x != c.x) return neighbour.x > c.x ? 0 : 2;
  return neighbour.y > c.y ? 1 : 3;
}

/// Adds up what the rays from one cell would see.
class ViewTally {
 public:
  ViewTally(const ExplorationGrid& grid, Cell from, const CellSet& frontier_cells)
      : grid_(grid), frontier_cells_(frontier_cells), from_(from), view_{from, from} {}

  /// @param reach  cells.
  void follow(const Eigen::Vector2d& direction, double reach) {
    direction_ = direction;
    before_ = last_known_ = from_;
    counts_ = true;
    unknown_since_ = met_face_ = -1.0;
    const double end =
        followRay(grid_, from_, direction, reach,
                  [this](Cell c, CellState state, double entered) { enter(c, state, entered); });
    closeStretch(end);
    if (met_face_ >= 0.0 && end < reach) addFace();
  }

  ViewPoint result() const {
    ViewPoint view = view_;
    if (longest_ == 0.0 && !before_faces_.empty())
      view.target = before_faces_[before_faces_.size() / 2];
    view.gain *= grid_.resolution() * grid_.resolution();
    view.expected *= grid_.resolution() * grid_.resolution();
    return view;
  }

 private:
  void enter(Cell c, CellState state, double entered) {
    const std::size_t side = sideOf(c, before_);
    const bool is_face = entered > 0.0 && isOpaque(state) && grid_.isFaceUnseen(c, side);
    met_face_ = is_face && frontier_cells_.contains(last_known_) ? entered : -1.0;
    before_ = c;
    if (state != CellState::kUnknown) {
      closeStretch(entered);
      if (!isOpaque(state)) last_known_ = c;
    } else if (unknown_since_ < 0.0) {
      unknown_since_ = entered;
      counts_ = frontier_cells_.contains(last_known_);
    }
  }

  /// A stretch of the unknown ends, if the ray is in one.
  void closeStretch(double end) {
    const double begin = std::exchange(unknown_since_, -1.0), passed = end - begin;
    if (begin < 0.0 || !counts_) return;
    const double free_way = kFreeWay / grid_.resolution();
    const double fading = std::exp(-passed / free_way);
    view_.gain += (end * end - begin * begin) * M_PI / kCount;
    view_.expected +=
        ((begin + free_way) * (1.0 - fading) - passed * fading) * free_way * 2.0 * M_PI / kCount;
    if (passed <= longest_) return;
    longest_ = passed;
    view_.target = cellAt(middleOf(from_) + 0.5 * (begin + end) * direction_);
  }

  void addFace() {
    const double across = 2.0 * M_PI / kCount / grid_.resolution();
    view_.gain += kFace * across * met_face_;
    view_.expected += kExpectedOfFace * across * met_face_;
    before_faces_.push_back(last_known_);
  }

  const ExplorationGrid& grid_;
  const CellSet& frontier_cells_;
  Cell from_;
  ViewPoint view_;
  double longest_ = 0.0;  ///< cells, the longest stretch of the unknown so far
  std::vector<Cell> before_faces_;
  // Of the present ray, lengths in cells.
  Eigen::Vector2d direction_ = Eigen::Vector2d::Zero();
  Cell before_, last_known_;  ///< last_known_: and no obstacle
  bool counts_ = true;        ///< whether the stretch begins at a frontier
  double unknown_since_ = -1.0;
  double met_face_ = -1.0;  ///< where it meets the face of an obstacle that was not seen
};

/// Marks the rays (of as many as `marks` all around) from the middle of a cell that may enter
/// another one within `reach` cells.
void markRays(Cell from, Cell to, double reach, std::vector<bool>& marks) {
  const Eigen::Vector2d way = middleOf(to) - middleOf(from);
  const double squared = way.squaredNorm(), farthest = reach + 1.0;
  if (squared > farthest * farthest) return;
  const auto count = static_cast<int>(marks.size());
  const double rays_per_rad = count / (2.0 * M_PI);
  const double half = squared > 2.0 ? std::asin(std::sqrt(0.5 / squared)) : M_PI;
  const double middle = std::atan2(way.y(), way.x());
  const int first = static_cast<int>(std::floor((middle - half) * rays_per_rad - 0.5));
  const int last = static_cast<int>(std::ceil((middle + half) * rays_per_rad - 0.5));
  for (int k = first; k <= std::min(last, first + count - 1); ++k)
    marks[static_cast<std::size_t>((k % count + count) % count)] = true;
}

constexpr double kPerMetre = 0.2;  // lambda of [Gonzalez-Banos & Latombe 2002]

}  // namespace

bool isInView(const ExplorationGrid& grid, Cell from, Cell to, double range) {
  const Eigen::Vector2d line = middleOf(to) - middleOf(from);
  const double length = line.norm();
  if (length == 0.0) return true;
  if (length * grid.resolution() > range) return false;
  const double longest = kThroughUnknown / grid.resolution();
  bool clear = true;
  double known = length;
  walkBeam(middleOf(from), line / length, length, [&](Cell c, double entered) {
    const CellState state = grid.at(c);
    if (state == CellState::kUnknown) known = std::min(known, entered);
    clear = !isOpaque(state) && length - known <= longest;
    return clear;
  });
  return clear;
}

ViewPoint viewFrom(const ExplorationGrid& grid, Cell from, double range,
                   const CellSet& frontier_cells) {
  const double reach = range / grid.resolution();
  std::vector<bool> meets_frontier(kRays.size(), false);
  for (const Cell c : frontier_cells.cells()) markRays(from, c, reach, meets_frontier);
  ViewTally tally(grid, from, frontier_cells);
  for (std::size_t k = 0; k < kRays.size(); ++k) {
    if (meets_frontier[k]) tally.follow(kRays[k], reach);
  }
  return tally.result();
}

double scoreOf(Strategy strategy, const ViewPoint& view_point) {
  switch (strategy) {
    case Strategy::kViewTour:
      return view_point.expected * std::exp(-kPerMetre * view_point.distance);
    case Strategy::kGainDistance:
      return view_point.gain * std::exp(-kPerMetre * view_point.distance);
    case Strategy::kInformation:
      return view_point.gain / std::max(view_point.distance, kShortestWay);
    case Strategy::kNearestFrontier:
      return -view_point.distance;
    case Strategy::kGreedy:
      break;
  }
  return view_point.gain;
}

std::vector<ViewPoint> frontierPlaces(const PlanningScene& scene, std::size_t smallest_frontier,
                                      double smallest_gain) {
  const CellSet frontier_cells = scene.world().usefulFrontierCells(smallest_frontier);
  std::vector<ViewPoint> places;
  for (const Frontier& frontier : scene.world().frontiers()) {
    Cell entry;
    if (frontier.cells.size() < smallest_frontier ||
        !nearestTraversable(scene.space(), frontier.middle, kBesideWalls, entry) ||
        !scene.distances().isReached(entry) || scene.isExhausted(entry))
      continue;
    ViewPoint view = viewFrom(scene.grid(), entry, scene.world().laserRange(), frontier_cells);
    view.distance = scene.distances().distanceTo(entry);
    if (view.gain >= smallest_gain && !scene.isBlacklisted(view.target)) places.push_back(view);
  }
  return places;
}

}  // namespace cca
