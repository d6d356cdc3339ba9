// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/view_points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "cca_mrpt/geometry/cross.hpp"
#include "cca_mrpt/navigation/place/cell.hpp"
#include "cca_mrpt/sensing/beam.hpp"

namespace cca {
namespace {

constexpr double kFreeWay = 0.5;  // m, that a ray gets in the unknown on average

/// Cells' length that fine rays may go through opaque ones: cutting corners, but not through a
/// wall. A surface on the border of two cells makes both occupied, and a ray that grazes it, or the
/// jamb of a door, would end there.
constexpr double kCut = 1.0;

/// Unit vectors all around.
using Rays = std::vector<Eigen::Vector2d>;

/// Never along an axis: no ties at corners.
Rays rays(int count) { return directionsAround(count, M_PI / count); }

const Rays kViewRays = rays(90), kGainRays = rays(72), kFineRays = rays(360);

bool isOpaque(CellState state) {
  return state == CellState::kPresumedWall || state == CellState::kOccupied;
}

/// Follows a ray to where it has gone through more than `cut` cells' length of opaque cells.
/// @param visit  void(Cell, CellState, double entered): for each cell, see walkBeam.
/// @return the ray's length, in cells.
template <class Visit>
double followRay(const ExplorationGrid& grid, Cell from, const Eigen::Vector2d& direction,
                 double reach, double cut, Visit&& visit) {
  double end = reach, opaque = 0.0, opaque_since = -1.0;
  walkBeam(middleOf(from), direction, reach, [&](Cell c, double entered) {
    if (opaque_since >= 0.0) {
      opaque += entered - opaque_since;
      if (opaque > cut) {
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

/// See viewFrom().
/// @param cut         see followRay.
/// @param is_opening  bool(Cell).
/// @param counts_ray  bool(ray): whether it may meet one.
template <class CountsRay, class IsOpening>
ViewPoint look(const ExplorationGrid& grid, Cell from, double range, const Rays& directions,
               double cut, CountsRay&& counts_ray, IsOpening&& is_opening) {
  ViewPoint view{from, from};
  const double free_way = kFreeWay / grid.resolution();
  const auto count = static_cast<double>(directions.size());
  double longest = 0.0;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    if (!counts_ray(k)) continue;
    const Eigen::Vector2d& direction = directions[k];
    double unknown_since = -1.0;
    bool counts = true;
    Cell last = from;  // that is known, and no obstacle
    const auto close = [&](double end) {
      const double begin = std::exchange(unknown_since, -1.0), passed = end - begin;
      if (begin < 0.0 || !counts) return;
      const double fading = std::exp(-passed / free_way);
      view.gain += (end * end - begin * begin) * M_PI / count;
      view.expected +=
          ((begin + free_way) * (1.0 - fading) - passed * fading) * free_way * 2.0 * M_PI / count;
      if (passed <= longest) return;
      longest = passed;
      view.target = cellAt(middleOf(from) + 0.5 * (begin + end) * direction);
    };
    const auto enter = [&](Cell c, CellState state, double entered) {
      if (state != CellState::kUnknown) {
        close(entered);
        if (!isOpaque(state)) last = c;
      } else if (unknown_since < 0.0) {
        unknown_since = entered;
        counts = is_opening(last);
      }
    };
    close(followRay(grid, from, direction, range / grid.resolution(), cut, enter));
  }
  view.gain *= grid.resolution() * grid.resolution();
  view.expected *= grid.resolution() * grid.resolution();
  return view;
}

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

constexpr double kPerMetre = 0.2;     // lambda of [Gonzalez-Banos & Latombe 2002]
constexpr double kShortestWay = 0.2;  // m: ways are measured in blocks of this size

double score(Strategy strategy, const ViewPoint& view_point) {
  switch (strategy) {
    case Strategy::kGreedy:
      return view_point.gain;
    case Strategy::kGainDistance:
      return discountedGain(view_point);
    case Strategy::kInformation:
      return view_point.gain / std::max(view_point.distance, kShortestWay);
    case Strategy::kNearestFrontier:
    case Strategy::kViewTour:
      break;
  }
  return -view_point.distance;
}

}  // namespace

Cell cellBehind(const ExplorationGrid& grid, const Frontier& frontier, double depth) {
  Eigen::Vector2d outwards = Eigen::Vector2d::Zero();
  for (const Cell c : frontier.cells) {
    for (std::size_t d = 0; d < 4; ++d) {
      if (grid.at(c + kNeighbours[d]) == CellState::kUnknown)
        outwards += Eigen::Vector2d(kNeighbours[d].x, kNeighbours[d].y);
    }
  }
  const Cell beside = unknownBeside(grid, frontier.middle).value_or(frontier.middle);
  if (outwards.norm() < 1.0) return beside;
  double end = depth / grid.resolution();
  bool entered_unknown = false;
  double first = 0.0;
  walkBeam(middleOf(frontier.middle), outwards.normalized(), end, [&](Cell c, double entered) {
    const CellState state = grid.at(c);
    if (state == CellState::kUnknown) {
      if (!entered_unknown) first = entered;
      entered_unknown = true;
      return true;
    }
    if (!entered_unknown && !isOpaque(state) && entered < 3.0) return true;
    end = entered;
    return false;
  });
  if (!entered_unknown) return beside;
  const double behind = end < depth / grid.resolution() ? 0.5 * (first + end) : end;
  const Eigen::Vector2d p = middleOf(frontier.middle) + behind * outwards.normalized();
  const Cell target = cellAt(p);
  return grid.at(target) == CellState::kUnknown ? target : beside;
}

bool isInView(const ExplorationGrid& grid, Cell from, Cell to) {
  const Eigen::Vector2d line = middleOf(to) - middleOf(from);
  const double length = line.norm();
  if (length == 0.0) return true;
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

void eachBlockInView(const ExplorationGrid& grid, Cell from, double range,
                     const std::function<void(Cell block)>& visit) {
  for (const Eigen::Vector2d& direction : kFineRays) {
    std::optional<Cell> block;
    followRay(grid, from, direction, range / grid.resolution(), kCut,
              [&](Cell c, CellState, double) {
                if (block && FreeSpace::blockOf(c) == *block) return;
                block = FreeSpace::blockOf(c);
                visit(*block);
              });
  }
}

std::optional<ViewPoint> nearestViewPoint(const ExplorationGrid& grid, const FreeSpace& space,
                                          const DistanceField& field, const ScannedPlaces& scanned,
                                          Cell target, double range) {
  std::optional<ViewPoint> best;
  const Eigen::Vector2d to_start = middleOf(field.start()) - middleOf(target);
  // Towards the start first: no way is shorter than the straight line between the blocks at its
  // ends, and so what is found there ends most of the others.
  const auto count = static_cast<int>(kViewRays.size());
  const auto first = static_cast<int>(
      std::floor(count * std::atan2(to_start.y(), to_start.x()) / (2.0 * M_PI)) + count);
  for (int k = first; k < first + count; ++k) {
    const Eigen::Vector2d& direction = kViewRays[static_cast<std::size_t>(k % count)];
    double reach = range / grid.resolution();
    if (best) {
      const double farthest = best->distance / grid.resolution() + 2.0 * FreeSpace::kBlock;
      const double aside = cross(direction, to_start);
      if (std::abs(aside) >= farthest) continue;
      reach =
          std::min(reach, direction.dot(to_start) + std::sqrt(farthest * farthest - aside * aside));
    }
    bool in_known = false;
    walkBeam(middleOf(target), direction, reach, [&](Cell c, double) {
      if (c == target) return true;
      const CellState state = grid.at(c);
      if (isOpaque(state) || (in_known && state == CellState::kUnknown)) return false;
      in_known = in_known || state != CellState::kUnknown;
      if (!space.isTraversable(c) || scanned.contains(c)) return true;
      const double distance = field.distanceTo(c);
      if (distance < (best ? best->distance : DistanceField::kUnreached))
        best = ViewPoint{c, target, distance};
      return true;
    });
  }
  return best;
}

double unknownAreaInView(const ExplorationGrid& grid, Cell from, double range) {
  const auto any = [](auto) { return true; };
  return look(grid, from, range, kGainRays, 0.0, any, any).gain;
}

ViewPoint viewFrom(const ExplorationGrid& grid, Cell from, double range, const CellSet& openings) {
  std::vector<bool> counts(kFineRays.size(), false);
  for (const Cell c : openings.cells()) markRays(from, c, range / grid.resolution(), counts);
  return look(
      grid, from, range, kFineRays, kCut, [&](std::size_t k) { return counts[k]; },
      [&](Cell c) { return openings.contains(c); });
}

double discountedGain(const ViewPoint& view_point) {
  return view_point.gain * std::exp(-kPerMetre * view_point.distance);
}

Strategy strategyNamed(const std::string& name) {
  std::string names;
  for (const auto& [known, strategy] : kStrategyNames) {
    if (name == known) return strategy;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw std::runtime_error("strategy '" + name + "' is none of " + names);
}

std::optional<std::size_t> selectGoal(Strategy strategy,
                                      const std::vector<ViewPoint>& view_points) {
  if (view_points.empty()) return {};
  const auto best = std::max_element(view_points.begin(), view_points.end(),
                                     [strategy](const ViewPoint& a, const ViewPoint& b) {
                                       return score(strategy, a) < score(strategy, b);
                                     });
  return static_cast<std::size_t>(best - view_points.begin());
}

}  // namespace cca
