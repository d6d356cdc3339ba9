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

std::optional<ViewPoint> nearestViewPoint(const ExplorationGrid& grid, const FreeSpace& space,
                                          const DistanceField& field, Cell target, double range,
                                          int rays) {
  std::optional<ViewPoint> best;
  for (int k = 0; k < rays; ++k) {
    walkBeam(middle(target), rayDirection(k, rays), range / grid.resolution(), [&](Cell c, double) {
      if (c == target) return true;
      if (grid.at(c) != CellState::kFree) return false;
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
      if (state == CellState::kOccupied || state == CellState::kPresumedWall) {
        end = entered;
        return false;
      }
      if (state == CellState::kFree) close(entered);
      if (state == CellState::kUnknown && unknown_since < 0.0) unknown_since = entered;
      return true;
    });
    close(end);
  }
  return area * grid.resolution() * grid.resolution();
}

}  // namespace cca
