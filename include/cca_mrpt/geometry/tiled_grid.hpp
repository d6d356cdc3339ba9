// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "cca_mrpt/geometry/cell.hpp"

namespace cca {

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
  static constexpr int kBits =
      6;  // tiles of 64 x 64 cells: a page of memory for bytes, cut by shifts
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

/// Cells, none twice, that come and go.
class CellSet {
 public:
  /// Precondition: isStorable(c). Cost: O(1), as of all that follows.
  void insert(Cell c) {
    if (contains(c)) return;
    cells_.push_back(c);
    place_[c] = static_cast<std::uint32_t>(cells_.size());
  }

  /// The last one takes the place of the one that goes.
  void erase(Cell c) {
    if (!contains(c)) return;
    const std::uint32_t place = place_[c];
    place_[cells_.back()] = place;
    cells_[place - 1] = cells_.back();
    cells_.pop_back();
    place_[c] = 0;
  }

  bool contains(Cell c) const { return place_.at(c) != 0; }
  /// The order depends only on what came and went.
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::vector<Cell> cells_;
  TiledGrid<std::uint32_t> place_{0};  ///< index in cells_, plus 1; 0: not among them
};

}  // namespace cca
