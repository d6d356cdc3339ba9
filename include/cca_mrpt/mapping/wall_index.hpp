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
  static constexpr double kCellSize = 0.5;  ///< m

  WallIndex() = default;
  WallIndex(const WallIndex& other);
  WallIndex& operator=(const WallIndex& other);
  WallIndex(WallIndex&&) = default;
  WallIndex& operator=(WallIndex&&) = default;

  static Cell cellOf(const Eigen::Vector2d& point) {
    return {below(point.x() / kCellSize), below(point.y() / kCellSize)};
  }

  /// The walls of a cell, in order of insertion; empty where nothing is.
  const std::vector<Slot>& at(const Cell& cell) const;

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
  static std::int64_t keyOf(const Cell& cell);
  std::vector<Slot>& touch(const Cell& cell);

  std::unordered_map<std::int64_t, std::unique_ptr<Block>> blocks_;
  mutable std::int64_t last_key_ = 0;
  mutable const Block* last_block_ = nullptr;
};

}  // namespace cca
