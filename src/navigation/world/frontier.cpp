// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/world/frontier.hpp"

#include <algorithm>

namespace cca {
namespace {

constexpr int kWide = 5;  // cells, of the square around one in which another is its neighbour

Cell memberInTheMiddle(const std::vector<Cell>& cells) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Cell c : cells) mean += Eigen::Vector2d(c.x, c.y) / static_cast<double>(cells.size());
  const auto off = [&](Cell c) { return (Eigen::Vector2d(c.x, c.y) - mean).squaredNorm(); };
  return *std::min_element(cells.begin(), cells.end(),
                           [&](Cell a, Cell b) { return off(a) < off(b); });
}

}  // namespace

bool isFrontier(const ExplorationGrid& grid, Cell c) {
  const auto is_unknown = [&](Cell step) { return grid.at(c + step) == CellState::kUnknown; };
  return isFree(grid.at(c)) &&
         std::any_of(kNeighbours.begin(), kNeighbours.begin() + 4, is_unknown);
}

bool isBesideUnseenFace(const ExplorationGrid& grid, Cell c) {
  if (!isFree(grid.at(c))) return false;
  for (std::size_t side = 0; side < 4; ++side) {
    if (grid.isFaceUnseen(c + kNeighbours[side], (side + 2) % 4)) return true;
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
  if (is_one_(grid, c)) {
    all_.insert(c);
  } else {
    all_.erase(c);
  }
}

std::vector<Frontier> FrontierCells::frontiers(int extent) const {
  TiledGrid<char> grouped{0};
  std::vector<Frontier> frontiers;
  for (const Cell seed : cells()) {
    if (grouped.at(seed)) continue;
    Frontier frontier;
    Cell low = seed, high = seed;
    frontier.cells.push_back(seed);
    grouped[seed] = 1;
    for (std::size_t i = 0; i < frontier.cells.size(); ++i) {
      for (int k = 0; k < kWide * kWide; ++k) {
        const Cell c = frontier.cells[i] + Cell{k % kWide - kWide / 2, k / kWide - kWide / 2};
        if (!all_.contains(c) || grouped.at(c)) continue;
        const Cell new_low{std::min(low.x, c.x), std::min(low.y, c.y)};
        const Cell new_high{std::max(high.x, c.x), std::max(high.y, c.y)};
        if (std::max(new_high.x - new_low.x, new_high.y - new_low.y) >= extent) continue;
        low = new_low;
        high = new_high;
        grouped[c] = 1;
        frontier.cells.push_back(c);
      }
    }
    frontier.middle = memberInTheMiddle(frontier.cells);
    frontiers.push_back(std::move(frontier));
  }
  return frontiers;
}

}  // namespace cca
