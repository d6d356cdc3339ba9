// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/barred_ways.hpp"

#include <algorithm>

#include "cca_mrpt/navigation/aside_goals.hpp"
#include "cca_mrpt/navigation/beam.hpp"

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

void BarredWays::bar(const std::vector<Eigen::Vector2d>& way, double resolution,
                     std::size_t revealed, FreeSpace& space) {
  BarredWay barred{{}, revealed};
  for (const Cell c : cellsAhead(way, resolution)) {
    for (int y = -kAside; y <= kAside; ++y) {
      for (int x = -kAside; x <= kAside; ++x) barred.cells.push_back(c + Cell{x, y});
    }
  }
  for (const Cell c : barred.cells) space.bar(c, true);
  ways_.push_back(std::move(barred));
}

bool BarredWays::recall(std::size_t revealed, FreeSpace& space) {
  const auto open = std::stable_partition(ways_.begin(), ways_.end(), [&](const BarredWay& way) {
    return revealed <= way.revealed_then + AsideGoals::kWorthAnotherTry;
  });
  const bool any = open != ways_.end();
  for (auto way = open; way != ways_.end(); ++way) {
    for (const Cell c : way->cells) space.bar(c, false);
  }
  ways_.erase(open, ways_.end());
  // A cell may have been barred twice.
  for (const BarredWay& way : ways_) {
    for (const Cell c : way.cells) space.bar(c, true);
  }
  return any;
}

bool BarredWays::openAll(FreeSpace& space) {
  for (const BarredWay& way : ways_) {
    for (const Cell c : way.cells) space.bar(c, false);
  }
  const bool any = !ways_.empty();
  ways_.clear();
  return any;
}

}  // namespace cca
