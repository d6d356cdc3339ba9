// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/wall_index.hpp"

#include <algorithm>

#include "geometry/cells_near.hpp"

namespace cca {

void WallIndex::insert(Slot slot, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                       double margin, std::vector<Cell>& cells) {
  visitCellsNear(from, to, margin, kCellSize, [&](cca::Cell low, cca::Cell high) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        std::vector<Slot>& slots = cells_[keyOf({x, y})];
        if (std::find(slots.begin(), slots.end(), slot) != slots.end()) continue;
        slots.push_back(slot);
        cells.emplace_back(x, y);
      }
    }
  });
}

void WallIndex::remove(Slot slot, const std::vector<Cell>& cells) {
  for (const Cell& cell : cells) {
    std::vector<Slot>& slots = cells_[keyOf(cell)];
    slots.erase(std::remove(slots.begin(), slots.end(), slot), slots.end());
  }
}

}  // namespace cca
