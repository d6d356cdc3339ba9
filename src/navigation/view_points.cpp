// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/view_points.hpp"

#include <cassert>
#include <cmath>

#include "cca_mrpt/navigation/beam.hpp"

namespace cca {
namespace {

constexpr double kPi = 3.14159265358979323846;

Eigen::Vector2d rayDirection(int k, int rays) {
  const double angle = 2.0 * kPi * (k + 0.5) / rays;  // never along an axis: no ties at corners
  return {std::cos(angle), std::sin(angle)};
}

Eigen::Vector2d middle(Cell c) { return {c.x + 0.5, c.y + 0.5}; }

}  // namespace

Cell unknownBeside(const ExplorationGrid& grid, Cell c) {
  for (std::size_t d = 0; d < 4; ++d) {
    if (grid.at(c + kNeighbours[d]) == CellState::kUnknown) return c + kNeighbours[d];
  }
  assert(false && "not a frontier cell");
  return c;
}

bool isOpaque(CellState state) {
  return state >= CellState::kGuessedWall && state != CellState::kFree;
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
  walkBeam(middle(from), line / length, length, [&](Cell c, double) {
    clear = !isOpaque(grid.at(c));
    return clear;
  });
  return clear;
}

std::optional<ViewPoint> nearestViewPoint(const ExplorationGrid& grid, const FreeSpace& space,
                                          const DistanceField& field,
                                          const TiledGrid<char>& scanned, Cell target, double range,
                                          int rays) {
  std::optional<ViewPoint> best;
  for (int k = 0; k < rays; ++k) {
    bool in_known = false;
    walkBeam(middle(target), rayDirection(k, rays), range / grid.resolution(), [&](Cell c, double) {
      if (c == target) return true;
      const CellState state = grid.at(c);
      if (isOpaque(state) || (in_known && state == CellState::kUnknown)) return false;
      in_known = in_known || state != CellState::kUnknown;
      if (scanned.at(FreeSpace::blockOf(c))) return true;
      if (!space.isTraversable(c)) return true;
      const double distance = field.distanceTo(c);
      if (distance < (best ? best->distance : DistanceField::kUnreached))
        best = ViewPoint{c, target, distance, 0.0};
      return true;
    });
  }
  return best;
}

double unknownAreaInView(const ExplorationGrid& grid, Cell from, double range, int rays) {
  double area = 0.0;  // in cells
  const double reach = range / grid.resolution();
  for (int k = 0; k < rays; ++k) {
    double unknown_since = -1.0;
    const auto close = [&](double until) {
      if (unknown_since >= 0.0)
        area += (until * until - unknown_since * unknown_since) * kPi / rays;
      unknown_since = -1.0;
    };
    double end = reach;
    walkBeam(middle(from), rayDirection(k, rays), reach, [&](Cell c, double entered) {
      const CellState state = grid.at(c);
      if (isOpaque(state)) {
        end = entered;
        return false;
      }
      if (state != CellState::kUnknown) close(entered);
      if (state == CellState::kUnknown && unknown_since < 0.0) unknown_since = entered;
      return true;
    });
    close(end);
  }
  return area * grid.resolution() * grid.resolution();
}

}  // namespace cca
