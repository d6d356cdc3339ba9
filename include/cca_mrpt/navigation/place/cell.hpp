// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
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

  /// The value of a neighbour, for writing, found from the value itself: no look-up inside a tile.
  /// Precondition: &value == &(*this)[c], |step| <= 1 in x and y, isStorable(c + step).
  T& beside(T& value, Cell c, Cell step) {
    const int x = (c.x & (kSide - 1)) + step.x, y = (c.y & (kSide - 1)) + step.y;
    if (static_cast<unsigned>(x) >= kSide || static_cast<unsigned>(y) >= kSide)
      return (*this)[c + step];
    return *(&value + (step.y * kSide + step.x));
  }

  /// The values of the eight neighbours, in the order of kNeighbours. Anywhere.
  std::array<T, 8> around(Cell c) const {
    const int x = c.x & (kSide - 1), y = c.y & (kSide - 1);
    const T* centre = x > 0 && y > 0 && x < kSide - 1 && y < kSide - 1 ? tileOf(c) : nullptr;
    std::array<T, 8> values;
    if (centre) centre += offset(c);
    for (std::size_t d = 0; d < kNeighbours.size(); ++d) {
      const Cell step = kNeighbours[d];
      values[d] = centre ? centre[step.y * kSide + step.x] : at(c + step);
    }
    return values;
  }

  /// Reads cells near each other, one after the other: a tile is looked up only where the way
  /// leaves it. What is read is out of date after a write to the grid; make a new one then.
  class Reader {
   public:
    explicit Reader(const TiledGrid& grid) : grid_(grid) {}
    const T& at(Cell c) {
      if (!is_in_tile_ || ((c.x ^ last_.x) | (c.y ^ last_.y)) >> kBits) {
        tile_ = grid_.tileOf(c);
        is_in_tile_ = true;
      }
      last_ = c;
      return tile_ ? tile_[offset(c)] : grid_.blank_;
    }

   private:
    const TiledGrid& grid_;
    const T* tile_ = nullptr;
    Cell last_;
    bool is_in_tile_ = false;
  };

 private:
  static constexpr int kBits = 6;
  static constexpr int kSide = 1 << kBits;
  static std::size_t offset(Cell c) {
    return static_cast<std::size_t>(((c.y & (kSide - 1)) << kBits) | (c.x & (kSide - 1)));
  }

  /// The first cell of the tile that holds a cell; null where there is no tile.
  const T* tileOf(Cell c) const {
    const auto column = static_cast<unsigned>((c.x >> kBits) - lowest_.x);
    const auto row = static_cast<unsigned>((c.y >> kBits) - lowest_.y);
    if (column >= columns_ || row >= rows_) return nullptr;
    const std::vector<T>& tile = tiles_[std::size_t{row} * columns_ + column];
    return tile.empty() ? nullptr : tile.data();
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
