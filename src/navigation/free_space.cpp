// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/free_space.hpp"

#include <algorithm>
#include <cmath>

namespace cca {

FreeSpace::FreeSpace(double clearance, double resolution) : clearance_(clearance) {
  const double reach = clearance / resolution;
  const int n = static_cast<int>(std::ceil(reach + 0.5));
  for (int y = -n; y <= n; ++y) {
    for (int x = -n; x <= n; ++x) {
      const double gap_x = std::max(std::abs(x) - 0.5, 0.0),
                   gap_y = std::max(std::abs(y) - 0.5, 0.0);
      if (std::hypot(gap_x, gap_y) < reach - 1e-9) disc_.push_back({x, y});
    }
  }
}

void FreeSpace::update(const ExplorationGrid& grid, const std::vector<Cell>& changed) {
  for (const Cell c : changed) {
    const CellState state = grid.at(c);
    std::uint32_t& cell = cells_[c];
    const bool was_occupied = cell & kOccupied, is_occupied = state == CellState::kOccupied;
    cell &= ~(kFree | kOccupied);
    if (state == CellState::kFree || state == CellState::kPresumedFree) cell |= kFree;
    if (is_occupied) cell |= kOccupied;
    if (is_occupied != was_occupied) grow(c, is_occupied);
    mark(c);
  }
}

void FreeSpace::grow(Cell obstacle, bool is_growing) {
  for (const Cell offset : disc_) {
    const Cell c = obstacle + offset;
    if (!isStorable(c)) continue;
    std::uint32_t& cell = cells_[c];
    const bool was_traversable = isTraversable(cell);
    cell = is_growing ? cell + 1 : cell - 1;
    if (was_traversable != isTraversable(cell)) mark(c);
  }
}

void FreeSpace::pass(Cell c) {
  if (!isStorable(c)) return;
  cells_[c] |= kPassed;
  mark(c);
}

void FreeSpace::bar(Cell c, bool is_barred) {
  if (!isStorable(c)) return;
  std::uint32_t& cell = cells_[c];
  cell = is_barred ? cell | kBarred : cell & ~kBarred;
  mark(c);
}

void FreeSpace::mark(Cell c) {
  std::uint16_t& block = blocks_[blockOf(c)];
  const unsigned bit = bitOf(c);
  block = static_cast<std::uint16_t>(isTraversable(c) ? block | bit : block & ~bit);
}

}  // namespace cca
