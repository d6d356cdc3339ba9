// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/barred_ways.hpp"

#include <algorithm>
#include <utility>

#include "cca_mrpt/navigation/place/beam.hpp"

namespace cca {
namespace {

constexpr double kAhead = 0.6;  // m
constexpr int kAside = 2;       // cells, to both sides

/// The cells that the beginning of a way crosses.
std::vector<Cell> cellsAhead(const std::vector<Eigen::Vector2d>& way, double resolution) {
  std::vector<Cell> cells;
  double left = kAhead / resolution;
  for (std::size_t i = 1; i < way.size() && left > 0.0; ++i) {
    const Eigen::Vector2d from = way[i - 1] / resolution, step = way[i] / resolution - from;
    const double length = step.norm();
    if (length == 0.0) continue;
    walkBeam(from, step / length, std::min(length, left), [&](Cell c, double) {
      cells.push_back(c);
      return true;
    });
    left -= length;
  }
  return cells;
}

}  // namespace

void BarredWays::bar(const std::vector<Eigen::Vector2d>& way, double resolution, FreeSpace& space) {
  std::vector<Cell> cells;
  for (const Cell c : cellsAhead(way, resolution)) {
    for (int y = -kAside; y <= kAside; ++y) {
      for (int x = -kAside; x <= kAside; ++x) cells.push_back(c + Cell{x, y});
    }
  }
  for (const Cell c : cells) space.bar(c, true);
  ways_.push_back(std::move(cells));
}

void BarredWays::move(const CellMove& moved, FreeSpace& space) {
  for (auto& cells : ways_) {
    for (Cell& c : cells) {
      c = moved(c);
      space.bar(c, true);
    }
  }
}

void BarredWays::openLast(FreeSpace& space) {
  if (ways_.empty()) return;
  for (const Cell c : ways_.back()) space.bar(c, false);
  ways_.pop_back();
  // A cell may have been barred twice.
  for (const auto& cells : ways_) {
    for (const Cell c : cells) space.bar(c, true);
  }
}

bool BarredWays::openAll(FreeSpace& space) {
  for (const auto& cells : ways_) {
    for (const Cell c : cells) space.bar(c, false);
  }
  const bool any = !ways_.empty();
  ways_.clear();
  return any;
}

}  // namespace cca
