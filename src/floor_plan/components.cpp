// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/components.hpp"

#include <algorithm>

namespace cca {
namespace {

/// Labels all that hangs together with a cell, and notes its size and box.
void flood(const Mask& mask, Cell seed, int neighbours, Components& found,
           std::vector<Cell>& open) {
  const int label = static_cast<int>(found.sizes.size());
  Cell low = seed, high = seed;
  std::size_t size = 0;
  open.assign(1, seed);
  found.labels[seed] = label;
  while (!open.empty()) {
    const Cell c = open.back();
    open.pop_back();
    ++size;
    low = {std::min(low.x, c.x), std::min(low.y, c.y)};
    high = {std::max(high.x, c.x), std::max(high.y, c.y)};
    for (int k = 0; k < neighbours; ++k) {
      const Cell next = c + kNeighbours[static_cast<std::size_t>(k)];
      if (!mask.holds(next) || !mask[next] || found.labels[next] >= 0) continue;
      found.labels[next] = label;
      open.push_back(next);
    }
  }
  found.sizes.push_back(size);
  found.lowest.push_back(low);
  found.highest.push_back(high);
}

}  // namespace

Components connectedComponents(const Mask& mask, int neighbours) {
  Components found;
  found.labels = mask.alike(-1);
  std::vector<Cell> open;
  for (std::size_t k = 0; k < mask.values.size(); ++k) {
    if (!mask.values[k] || found.labels.values[k] >= 0) continue;
    flood(mask, mask.cell(k), neighbours, found, open);
  }
  return found;
}

}  // namespace cca
