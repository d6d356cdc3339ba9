// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace cca {

/// A uniform grid over the plane that names, for each cell, the walls near it. Cells live in blocks
/// that are made when first needed: cost and memory follow the mapped area, not its bounding box.
class WallIndex {
 public:
  using Slot = std::int32_t;
  using Cell = Eigen::Vector2i;
  static constexpr double kCellSize = 0.8;  ///< m

  WallIndex() = default;
  WallIndex(const WallIndex& other);
  WallIndex& operator=(const WallIndex& other);
  WallIndex(WallIndex&&) = default;
  WallIndex& operator=(WallIndex&&) = default;

  static Cell cellOf(const Eigen::Vector2d& point) {
    return {below(point.x() / kCellSize), below(point.y() / kCellSize)};
  }

  /// The walls of a cell, in order of insertion; empty where nothing is.
  const std::vector<Slot>& at(const Cell& cell) const {
    const std::int64_t key = keyOf(cell);
    if ((last_block_ == nullptr || key != last_key_) && !find(key)) return none_;
    return last_block_->cells[inBlock(cell)];
  }

  /// Names `slot` in each cell that the segment comes within `margin` of; the cells that were not
  /// yet named are appended to `cells`.
  void insert(Slot slot, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double margin,
              std::vector<Cell>& cells);
  void remove(Slot slot, const std::vector<Cell>& cells);

 private:
  static int below(double x) {
    const int i = static_cast<int>(x);
    return x < i ? i - 1 : i;
  }
  static constexpr int kBlockBits = 4;
  struct Block {
    std::vector<Slot> cells[1 << (2 * kBlockBits)];
  };
  static std::int64_t keyOf(const Cell& cell) {
    const std::int64_t x = cell.x() >> kBlockBits, y = cell.y() >> kBlockBits;
    return x * (std::int64_t{1} << 32) + (y & 0xffffffffLL);
  }
  static std::size_t inBlock(const Cell& cell) {
    const int mask = (1 << kBlockBits) - 1;
    return static_cast<std::size_t>(((cell.y() & mask) << kBlockBits) | (cell.x() & mask));
  }
  /// Makes a block the last one; false where it does not exist.
  bool find(std::int64_t key) const;
  std::vector<Slot>& touch(const Cell& cell);

  inline static const std::vector<Slot> none_;
  std::unordered_map<std::int64_t, std::unique_ptr<Block>> blocks_;
  mutable std::int64_t last_key_ = 0;
  mutable const Block* last_block_ = nullptr;
};

}  // namespace cca
