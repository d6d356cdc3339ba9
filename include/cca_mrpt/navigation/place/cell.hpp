// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <limits>
#include <vector>

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
/// The cell that holds a point. @param p  in cells, finite.
inline Cell cellAt(const Eigen::Vector2d& p) {
  return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
}

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
  constexpr double kNever = std::numeric_limits<double>::infinity();
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

/// A value for each cell of the plane, all of them `blank` at first. It is stored in square tiles
/// that come into being where something is written: growing never copies a cell.
template <class T>
class TiledGrid {
 public:
  explicit TiledGrid(T blank = T{}) : blank_(blank) {}

  /// Cost: O(1). Anywhere.
  const T& at(Cell c) const {
    const auto column = static_cast<unsigned>((c.x >> kBits) - lowest_.x);
    const auto row = static_cast<unsigned>((c.y >> kBits) - lowest_.y);
    if (column >= columns_ || row >= rows_) return blank_;
    const std::vector<T>& tile = tiles_[std::size_t{row} * columns_ + column];
    return tile.empty() ? blank_ : tile[offset(c)];
  }

  /// The cell for writing. Precondition: isStorable(c). Cost: O(1), but for new tiles.
  T& operator[](Cell c) {
    const auto column = static_cast<unsigned>((c.x >> kBits) - lowest_.x);
    const auto row = static_cast<unsigned>((c.y >> kBits) - lowest_.y);
    if (column < columns_ && row < rows_) {
      std::vector<T>& tile = tiles_[std::size_t{row} * columns_ + column];
      if (!tile.empty()) return tile[offset(c)];
    }
    return create(c)[offset(c)];
  }

 private:
  static constexpr int kBits = 6;
  static constexpr int kSide = 1 << kBits;
  static std::size_t offset(Cell c) {
    return static_cast<std::size_t>(((c.y & (kSide - 1)) << kBits) | (c.x & (kSide - 1)));
  }

  std::vector<T>& create(Cell c) {
    const Cell tile{c.x >> kBits, c.y >> kBits};
    cover(tile);
    std::vector<T>& cells = tiles_[static_cast<std::size_t>(tile.y - lowest_.y) * columns_ +
                                   static_cast<std::size_t>(tile.x - lowest_.x)];
    if (cells.empty()) cells.assign(std::size_t{kSide} * kSide, blank_);
    return cells;
  }

  /// Widens the table of tiles until it holds the given one, by half its size at least.
  void cover(Cell tile) {
    const Cell end{lowest_.x + static_cast<int>(columns_), lowest_.y + static_cast<int>(rows_)};
    if (columns_ && tile.x >= lowest_.x && tile.y >= lowest_.y && tile.x < end.x && tile.y < end.y)
      return;
    Cell low = columns_ ? lowest_ : tile, high = columns_ ? end : tile + Cell{1, 1};
    const int wide = 1 + static_cast<int>(columns_) / 2, tall = 1 + static_cast<int>(rows_) / 2;
    if (tile.x < low.x) low.x = tile.x - wide;
    if (tile.y < low.y) low.y = tile.y - tall;
    if (tile.x >= high.x) high.x = tile.x + wide;
    if (tile.y >= high.y) high.y = tile.y + tall;
    TiledGrid wider(blank_);
    wider.lowest_ = low;
    wider.columns_ = static_cast<unsigned>(high.x - low.x);
    wider.rows_ = static_cast<unsigned>(high.y - low.y);
    wider.tiles_.resize(std::size_t{wider.columns_} * wider.rows_);
    for (unsigned row = 0; row < rows_; ++row) {
      for (unsigned column = 0; column < columns_; ++column) {
        const std::size_t to =
            (row + static_cast<unsigned>(lowest_.y - low.y)) * std::size_t{wider.columns_} +
            column + static_cast<unsigned>(lowest_.x - low.x);
        wider.tiles_[to].swap(tiles_[std::size_t{row} * columns_ + column]);
      }
    }
    *this = std::move(wider);
  }

  T blank_;
  Cell lowest_;
  unsigned columns_ = 0, rows_ = 0;
  std::vector<std::vector<T>> tiles_;
};

}  // namespace cca
