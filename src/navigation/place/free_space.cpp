// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace cca {
namespace {

/// Offsets of the cells that come nearer to a cell's centre than a distance, in cells.
std::vector<Cell> cellsWithin(double reach) {
  const int n = static_cast<int>(std::ceil(reach + 0.5));
  std::vector<Cell> cells;
  for (int y = -n; y <= n; ++y) {
    for (int x = -n; x <= n; ++x) {
      const double gap_x = std::max(std::abs(x) - 0.5, 0.0),
                   gap_y = std::max(std::abs(y) - 0.5, 0.0);
      if (std::hypot(gap_x, gap_y) < reach - 1e-9) cells.push_back({x, y});
    }
  }
  return cells;
}

}  // namespace

FreeSpace::FreeSpace(double clearance, double resolution)
    : clearance_(clearance), resolution_(resolution), disc_(cellsWithin(clearance / resolution)) {}

void FreeSpace::reduceClearance(double clearance, Cell low, Cell high) {
  clearance_ = clearance;
  std::vector<Cell> disc = cellsWithin(clearance / resolution_), ring;
  std::copy_if(disc_.begin(), disc_.end(), std::back_inserter(ring),
               [&](Cell c) { return std::find(disc.begin(), disc.end(), c) == disc.end(); });
  disc_ = std::move(disc);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (cells_.at({x, y}) & kOccupied) grow({x, y}, ring, false);
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
    if (is_occupied != was_occupied) grow(c, disc_, is_occupied);
    mark(c);
  }
}

void FreeSpace::grow(Cell obstacle, const std::vector<Cell>& disc, bool is_growing) {
  for (const Cell offset : disc) {
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
  const bool was_traversable = block & bitOf(c);
  if (was_traversable == isTraversable(c)) return;
  block = static_cast<std::uint16_t>(block ^ bitOf(c));
}

}  // namespace cca
