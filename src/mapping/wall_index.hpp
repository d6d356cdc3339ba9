// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cca_mrpt/geometry/cell.hpp"

namespace cca {

/// A uniform grid over the plane that names, for each cell, the walls near it. Cells are made when
/// first needed: cost and memory follow the mapped area, not its bounding box.
class WallIndex {
 public:
  using Slot = std::int32_t;
  using Cell = Eigen::Vector2i;
  /// m; some more than the 0.3 m around a wall that it is named in, to either side: smaller cells
  /// name it oftener, larger ones name walls that nobody asks for.
  static constexpr double kCellSize = 0.8;

  static Cell cellOf(const Eigen::Vector2d& point) {
    return {wholeBelow(point.x() / kCellSize), wholeBelow(point.y() / kCellSize)};
  }

  /// The walls of a cell, in order of insertion; empty where nothing is.
  const std::vector<Slot>& at(const Cell& cell) const {
    const auto found = cells_.find(keyOf(cell));
    return found == cells_.end() ? none_ : found->second;
  }

  /// Names `slot` in each cell that the segment comes within `margin` of; the cells that were not
  /// yet named are appended to `cells`.
  void insert(Slot slot, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double margin,
              std::vector<Cell>& cells);
  void remove(Slot slot, const std::vector<Cell>& cells);

 private:
  static std::int64_t keyOf(const Cell& cell) {
    return cell.x() * (std::int64_t{1} << 32) + cell.y();
  }

  inline static const std::vector<Slot> none_;
  std::unordered_map<std::int64_t, std::vector<Slot>> cells_;
};

}  // namespace cca
