// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/frontier.hpp"

#include <algorithm>
#include <limits>

namespace cca {
namespace {

Cell middleOf(const std::vector<Cell>& cells) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Cell c : cells) mean += Eigen::Vector2d(c.x, c.y) / static_cast<double>(cells.size());
  Cell middle = cells.front();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Cell c : cells) {
    const double distance = (Eigen::Vector2d(c.x, c.y) - mean).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    middle = c;
  }
  return middle;
}

}  // namespace

bool isFrontier(const ExplorationGrid& grid, Cell c) {
  const CellState state = grid.at(c);
  if (state != CellState::kFree && state != CellState::kPresumedFree) return false;
  for (std::size_t d = 0; d < 4; ++d) {
    if (grid.at(c + kNeighbours[d]) == CellState::kUnknown) return true;
  }
  return false;
}

void FrontierCells::update(const ExplorationGrid& grid, const std::vector<Cell>& changed) {
  for (const Cell c : changed) {
    review(grid, c);
    for (std::size_t d = 0; d < 4; ++d) review(grid, c + kNeighbours[d]);
  }
}

void FrontierCells::review(const ExplorationGrid& grid, Cell c) {
  if (!isStorable(c)) return;
  const bool was = place_.at(c) != 0, is = isFrontier(grid, c);
  if (was == is) return;
  if (is) {
    cells_.push_back(c);
    place_[c] = static_cast<std::uint32_t>(cells_.size());
    return;
  }
  // The last one takes the place of the one that goes.
  const std::uint32_t place = place_[c];
  place_[cells_.back()] = place;
  cells_[place - 1] = cells_.back();
  cells_.pop_back();
  place_[c] = 0;
}

std::vector<Frontier> FrontierCells::frontiers(int extent) {
  static const std::vector<Cell> kNear = [] {
    std::vector<Cell> near;
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x) near.push_back({x, y});
    return near;
  }();
  ++grouping_;
  std::vector<Frontier> frontiers;
  for (const Cell seed : cells_) {
    if (grouped_.at(seed) == grouping_) continue;
    Frontier frontier;
    Cell low = seed, high = seed;
    frontier.cells.push_back(seed);
    grouped_[seed] = grouping_;
    for (std::size_t i = 0; i < frontier.cells.size(); ++i) {
      for (const Cell step : kNear) {
        const Cell c = frontier.cells[i] + step;
        if (!contains(c) || grouped_.at(c) == grouping_) continue;
        const Cell new_low{std::min(low.x, c.x), std::min(low.y, c.y)};
        const Cell new_high{std::max(high.x, c.x), std::max(high.y, c.y)};
        if (std::max(new_high.x - new_low.x, new_high.y - new_low.y) >= extent) continue;
        low = new_low;
        high = new_high;
        grouped_[c] = grouping_;
        frontier.cells.push_back(c);
      }
    }
    frontier.middle = middleOf(frontier.cells);
    frontiers.push_back(std::move(frontier));
  }
  return frontiers;
}

}  // namespace cca
