// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

namespace cca {

/// A square of the plane: x in [x, x + 1) * resolution, y likewise; the map frame's origin is a
/// corner of cell (0, 0).
struct Cell {
  int x = 0;
  int y = 0;
};

inline bool operator==(Cell a, Cell b) { return a.x == b.x && a.y == b.y; }
inline bool operator!=(Cell a, Cell b) { return !(a == b); }
inline Cell operator+(Cell a, Cell b) { return {a.x + b.x, a.y + b.y}; }
/// Between their centres, in cells.
inline double distanceBetween(Cell a, Cell b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// In steps to any of the eight neighbours (Chebyshev).
inline int squareDistance(Cell a, Cell b) {
  return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
}

/// The middle of a cell, in cells.
inline Eigen::Vector2d middleOf(Cell c) { return {c.x + 0.5, c.y + 0.5}; }
/// The largest whole number up to x, which an int can hold: processors of before 2008 have no
/// instruction for std::floor(), and it is a call.
inline int wholeBelow(double x) {
  const int whole = static_cast<int>(x);
  return x < whole ? whole - 1 : whole;
}
/// The cell that holds a point. @param p  in cells, finite.
inline Cell cellAt(const Eigen::Vector2d& p) { return {wholeBelow(p.x()), wholeBelow(p.y())}; }

/// Visits the cells that a straight line crosses, in order [Amanatides & Woo 1987].
///
/// @param origin     start, in cells (metres / resolution).
/// @param direction  unit vector.
/// @param length     in cells; the visit ends with the last cell entered before it.
/// @param visit      bool(Cell, double entered): false ends the visit. `entered`: the distance from
///                   the origin, in cells, at which the line enters the cell (0 for the first).
/// Cost: O(length).
template <class Visit>
void walkBeam(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double length,
              Visit&& visit) {
  constexpr double kNever =
      std::numeric_limits<double>::infinity();  // a ray that runs along an axis meets no line
                                                // across it
  Cell c = cellAt(origin);
  const int step_x = direction.x() > 0.0 ? 1 : -1, step_y = direction.y() > 0.0 ? 1 : -1;
  const double spacing_x = direction.x() != 0.0 ? std::abs(1.0 / direction.x()) : kNever;
  const double spacing_y = direction.y() != 0.0 ? std::abs(1.0 / direction.y()) : kNever;
  double next_x = kNever, next_y = kNever;
  if (spacing_x < kNever)
    next_x = (direction.x() > 0.0 ? c.x + 1 - origin.x() : origin.x() - c.x) * spacing_x;
  if (spacing_y < kNever)
    next_y = (direction.y() > 0.0 ? c.y + 1 - origin.y() : origin.y() - c.y) * spacing_y;
  double entered = 0.0;
  while (entered <= length && visit(c, entered)) {
    if (next_x < next_y) {
      entered = next_x;
      next_x += spacing_x;
      c.x += step_x;
    } else {
      entered = next_y;
      next_y += spacing_y;
      c.y += step_y;
    }
  }
}

/// Where a cell of a map got to when that was corrected.
using CellMove = std::function<Cell(Cell)>;

/// The eight neighbours: right, up, left, down, then the diagonals.
constexpr std::array<Cell, 8> kNeighbours{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// Cells farther than this from the origin are not stored (3.2 km at 5 cm), so that a wild pose
/// cannot exhaust the memory.
constexpr int kFarthestCell = 1 << 16;

inline bool isStorable(Cell c) {
  return c.x > -kFarthestCell && c.x < kFarthestCell && c.y > -kFarthestCell && c.y < kFarthestCell;
}

}  // namespace cca
