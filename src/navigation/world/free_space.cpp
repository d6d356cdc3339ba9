// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/world/free_space.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

// Beside an open cell. With 1 to 2 more passages of the robot's width shut, 4 and 6 gain nothing;
// without end ways lead nearer to walls than the robot needs, where what is free is seen first.
constexpr int kNoisyCells = 3;
// Beside a cell that the robot has been in. Walls that are drawn 10 cm off, by poses that drift,
// are up to six, and shut the robot in; with twelve ways lead through the flank of who stands
// there.
constexpr int kDriftedCells = 8;

/// Cells, from the centre of the cell at an offset to the nearest point of the one at the origin.
double distanceTo(Cell offset) {
  return std::hypot(std::max(std::abs(offset.x) - 0.5, 0.0),
                    std::max(std::abs(offset.y) - 0.5, 0.0));
}

}  // namespace

bool FreeSpace::Place::isPassed() const {
  return is_passed && state != CellState::kOccupied && close <= kDriftedCells;
}

FreeSpace::FreeSpace(double clearance, double resolution) : clearance_(clearance) {
  const double reach = clearance / resolution - 1e-9;
  const int n = static_cast<int>(std::ceil(reach + 0.5));
  for (int y = -n; y <= n; ++y) {
    for (int x = -n; x <= n; ++x) {
      const double distance = distanceTo({x, y});
      if (distance >= reach) continue;
      disc_.push_back({{x, y}, distance < reach - 1.0});
    }
  }
}

// Obstacles first: what opens before them would stay open.
void FreeSpace::update(const ExplorationGrid& grid, const std::vector<Cell>& changed) {
  for (const bool is_occupied : {true, false}) {
    for (const Cell c : changed) {
      if ((grid.at(c) == CellState::kOccupied) != is_occupied) continue;
      Place& place = cells_[c];
      const bool was_occupied = place.state == CellState::kOccupied;
      place.state = grid.at(c);
      if (is_occupied != was_occupied) grow(c, is_occupied ? 1 : -1);
      settle(c, place);
    }
  }
}

void FreeSpace::grow(Cell obstacle, int count) {
  for (const auto& [offset, is_close] : disc_) {
    const Cell c = obstacle + offset;
    if (!isStorable(c)) continue;
    Place& place = cells_[c];
    place.near = static_cast<std::uint16_t>(place.near + count);
    if (is_close) place.close = static_cast<std::uint16_t>(place.close + count);
    settle(c, place);
  }
}

void FreeSpace::pass(Cell c) {
  if (!isStorable(c)) return;
  Place& place = cells_[c];
  place.is_passed = true;
  settle(c, place);
}

void FreeSpace::settle(Cell c, Place& place) {
  if (!isFree(place.state) || place.close > 0 || place.near > kNoisyCells) {
    place.is_open = false;
  } else if (place.near == 0) {
    place.is_open = true;
  }
  const unsigned before = blocks_.at(blockOf(c)), bit = bitOf(c), passed_bit = bit << kCellsOfBlock;
  unsigned after = before & ~(bit | passed_bit);
  if (place.is_open || place.isPassed()) after |= bit;
  if (place.isPassed()) after |= passed_bit;
  if (after != before) blocks_[blockOf(c)] = after;
}

}  // namespace cca
