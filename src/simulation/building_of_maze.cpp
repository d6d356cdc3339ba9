// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <vector>

#include "simulation/building_kinds.hpp"

namespace cca {

namespace {

constexpr int kColumns = 8, kRows = 6;
constexpr double kPitch = 2.0, kWall = 0.1;  // m

using Cell = std::array<int, 2>;

/// A spanning tree of the cells by a random depth-first walk: one way between any two places, and
/// so many dead ends. open[axis][x][y]: no wall between (x, y) and its next cell along the axis.
struct Passages {
  bool open[2][kColumns][kRows] = {};
};

Passages carve(Random& random) {
  Passages passages;
  bool visited[kColumns][kRows] = {};
  std::vector<Cell> way{{0, 0}};
  visited[0][0] = true;
  while (!way.empty()) {
    const auto [x, y] = way.back();
    std::vector<Cell> fresh;
    for (const auto& [nx, ny] : {Cell{x + 1, y}, Cell{x - 1, y}, Cell{x, y + 1}, Cell{x, y - 1}}) {
      if (nx < 0 || ny < 0 || nx >= kColumns || ny >= kRows || visited[nx][ny]) continue;
      fresh.push_back({nx, ny});
    }
    if (fresh.empty()) {
      way.pop_back();
      continue;
    }
    const Cell next = fresh[random.integer(0, static_cast<int>(fresh.size()) - 1)];
    const int axis = next[0] != x ? 0 : 1;
    passages.open[axis][std::min(x, next[0])][std::min(y, next[1])] = true;
    visited[next[0]][next[1]] = true;
    way.push_back(next);
  }
  return passages;
}

}  // namespace

/// 16 x 12 m of corridors 1.9 m wide.
Building maze(Random& random) {
  Building plan;
  plan.width = kColumns * kPitch + kWall;
  plan.height = kRows * kPitch + kWall;
  plan.start = {1.0, 1.0, 0.0};
  plan.addOuterWalls(kWall);
  const Passages passages = carve(random);
  for (int x = 0; x < kColumns; ++x) {
    for (int y = 0; y < kRows; ++y) {
      const double right = (x + 1) * kPitch, top = (y + 1) * kPitch;
      if (x + 1 < kColumns && !passages.open[0][x][y]) {
        plan.addBox({right, top - kPitch}, {right + kWall, top + kWall});
      }
      if (y + 1 < kRows && !passages.open[1][x][y]) {
        plan.addBox({right - kPitch, top}, {right + kWall, top + kWall});
      }
    }
  }
  return plan;
}

}  // namespace cca
