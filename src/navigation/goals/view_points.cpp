// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/view_points.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "cca_mrpt/navigation/place/beam.hpp"

namespace cca {
namespace {

constexpr double kPi = 3.14159265358979323846;

constexpr int kViewRays = 90, kGainRays = 72, kFineRays = 360;

constexpr double kFreeWay = 0.5;  // m, that a ray gets in the unknown on average

/// Cells' length that fine rays may go through opaque ones: cutting corners, but not through a
/// wall. A surface on the border of two cells makes both occupied, and a ray that grazes it, or the
/// jamb of a door, would end there.
constexpr double kCut = 1.0;

std::vector<Eigen::Vector2d> directions(int rays) {
  std::vector<Eigen::Vector2d> unit;
  for (int k = 0; k < rays; ++k) {
    const double angle = 2.0 * kPi * (k + 0.5) / rays;  // never along an axis: no ties at corners
    unit.emplace_back(std::cos(angle), std::sin(angle));
  }
  return unit;
}

bool isOpaque(CellState state) {
  return state >= CellState::kGuessedWall && state != CellState::kFree;
}

Eigen::Vector2d middle(Cell c) { return {c.x + 0.5, c.y + 0.5}; }

/// Follows a ray to where it has gone through more than `cut` cells' length of opaque cells.
/// @param visit  void(Cell, CellState, double entered): for each cell, see walkBeam.
/// @return the ray's length, in cells.
template <class Visit>
double followRay(ExplorationGrid::Reader& states, Cell from, const Eigen::Vector2d& direction,
                 double reach, double cut, Visit&& visit) {
  double end = reach, opaque = 0.0, opaque_since = -1.0;
  walkBeam(middle(from), direction, reach, [&](Cell c, double entered) {
    if (opaque_since >= 0.0) {
      opaque += entered - opaque_since;
      if (opaque > cut) {
        end = opaque_since;
        return false;
      }
      opaque_since = -1.0;
    }
    const CellState state = states.at(c);
    visit(c, state, entered);
    if (isOpaque(state)) opaque_since = entered;
    return true;
  });
  return end;
}

/// Follows rays up to opaque cells.
/// @param cut         see followRay.
/// @param is_opening  bool(Cell): whether what lies behind a known cell counts.
/// @param visit       void(direction, begin, end): for each stretch of unknown cells on a ray, with
///                    its distances from the beginning in cells.
template <class IsOpening, class Visit>
void eachUnknownStretch(const ExplorationGrid& grid, Cell from,
                        const std::vector<Eigen::Vector2d>& directions, double range, double cut,
                        IsOpening&& is_opening, Visit&& visit) {
  ExplorationGrid::Reader states(grid);
  for (const Eigen::Vector2d& direction : directions) {
    double unknown_since = -1.0;
    bool counts = true;
    Cell last = from;  // that is known, and no obstacle
    const auto close = [&](double until) {
      if (unknown_since >= 0.0 && counts) visit(direction, unknown_since, until);
      unknown_since = -1.0;
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
    close(followRay(states, from, direction, range / grid.resolution(), cut, enter));
  }
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

Cell unknownBeside(const ExplorationGrid& grid, Cell c) {
  for (std::size_t d = 0; d < 4; ++d) {
    if (grid.at(c + kNeighbours[d]) == CellState::kUnknown) return c + kNeighbours[d];
  }
  assert(false && "not a frontier cell");
  return c;
}

Cell cellBehind(const ExplorationGrid& grid, const Frontier& frontier, double depth) {
  Eigen::Vector2d outwards = Eigen::Vector2d::Zero();
  for (const Cell c : frontier.cells) {
    for (std::size_t d = 0; d < 4; ++d) {
      if (grid.at(c + kNeighbours[d]) == CellState::kUnknown)
        outwards += Eigen::Vector2d(kNeighbours[d].x, kNeighbours[d].y);
    }
  }
  const Cell beside = unknownBeside(grid, frontier.middle);
  if (outwards.norm() < 1.0) return beside;
  double end = depth / grid.resolution();
  bool entered_unknown = false;
  double first = 0.0;
  walkBeam(middle(frontier.middle), outwards.normalized(), end, [&](Cell c, double entered) {
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
  const Eigen::Vector2d p = middle(frontier.middle) + behind * outwards.normalized();
  const Cell target{static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
  return grid.at(target) == CellState::kUnknown ? target : beside;
}

bool isInView(const ExplorationGrid& grid, Cell from, Cell to) {
  const Eigen::Vector2d line = middle(to) - middle(from);
  const double length = line.norm();
  if (length == 0.0) return true;
  bool clear = true;
  ExplorationGrid::Reader states(grid);
  walkBeam(middle(from), line / length, length, [&](Cell c, double) {
    clear = !isOpaque(states.at(c));
    return clear;
  });
  return clear;
}

void eachBlockInView(const ExplorationGrid& grid, Cell from, double range,
                     const std::function<void(Cell block)>& visit) {
  static const std::vector<Eigen::Vector2d> kDirections = directions(kFineRays);
  ExplorationGrid::Reader states(grid);
  for (const Eigen::Vector2d& direction : kDirections) {
    std::optional<Cell> block;
    followRay(states, from, direction, range / grid.resolution(), kCut,
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
  static const std::vector<Eigen::Vector2d> kDirections = directions(kViewRays);
  std::optional<ViewPoint> best;
  ExplorationGrid::Reader states(grid);
  // The cells of the present block that may be nearer than the best so far.
  Cell block;
  unsigned eligible = 0;
  const auto enter = [&](Cell next) {
    block = next;
    const bool is_too_far = best && field.leastDistanceTo(block) >= best->distance;
    eligible = is_too_far || scanned.containsBlock(block) ? 0 : space.traversableCells(block);
  };
  enter(FreeSpace::blockOf(target));
  for (const Eigen::Vector2d& direction : kDirections) {
    bool in_known = false;
    walkBeam(middle(target), direction, range / grid.resolution(), [&](Cell c, double) {
      if (c == target) return true;
      const CellState state = states.at(c);
      if (isOpaque(state) || (in_known && state == CellState::kUnknown)) return false;
      in_known = in_known || state != CellState::kUnknown;
      if (FreeSpace::blockOf(c) != block) enter(FreeSpace::blockOf(c));
      if (!(eligible & FreeSpace::bitOf(c))) return true;
      const DistanceField::Reached reached = field.reached(c);
      eligible &= ~(FreeSpace::bitOf(c) | reached.cells);
      if (reached.distance < (best ? best->distance : DistanceField::kUnreached))
        best = ViewPoint{c, target, reached.distance, 0.0};
      return true;
    });
  }
  return best;
}

double unknownAreaInView(const ExplorationGrid& grid, Cell from, double range) {
  static const std::vector<Eigen::Vector2d> kDirections = directions(kGainRays);
  double area = 0.0;  // in cells
  eachUnknownStretch(
      grid, from, kDirections, range, 0.0, [](Cell) { return true; },
      [&](const Eigen::Vector2d&, double begin, double end) {
        area += (end * end - begin * begin) * kPi / kGainRays;
      });
  return area * grid.resolution() * grid.resolution();
}

ViewPoint viewFrom(const ExplorationGrid& grid, Cell from, double range,
                   const std::function<bool(Cell)>& is_opening) {
  static const std::vector<Eigen::Vector2d> kDirections = directions(kFineRays);
  ViewPoint view{from, from, 0.0, 0.0};
  const double free_way = kFreeWay / grid.resolution();
  double longest = 0.0;
  eachUnknownStretch(
      grid, from, kDirections, range, kCut, is_opening,
      [&](const Eigen::Vector2d& direction, double begin, double end) {
        view.gain += (end * end - begin * begin) * kPi / kFineRays;
        const double passed = end - begin, fading = std::exp(-passed / free_way);
        view.expected += ((begin + free_way) * (1.0 - fading) - passed * fading) * free_way * 2.0 *
                         kPi / kFineRays;
        if (end - begin <= longest) return;
        longest = end - begin;
        const Eigen::Vector2d p = middle(from) + 0.5 * (begin + end) * direction;
        view.target = {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
      });
  view.gain *= grid.resolution() * grid.resolution();
  view.expected *= grid.resolution() * grid.resolution();
  return view;
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
  std::optional<std::size_t> best;
  double best_score = 0.0;
  for (std::size_t i = 0; i < view_points.size(); ++i) {
    const double s = score(strategy, view_points[i]);
    if (best && s <= best_score) continue;
    best = i;
    best_score = s;
  }
  return best;
}

}  // namespace cca
