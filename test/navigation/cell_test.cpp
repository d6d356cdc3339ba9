// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/cell.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cca {
namespace {

/// Values in a patch that spans several tiles on both sides of the origin; the rest is blank.
TiledGrid<int> patchwork() {
  TiledGrid<int> grid(-1);
  for (int y = -70; y < 30; ++y) {
    for (int x = -130; x < 20; ++x) {
      if ((x + 130) / 64 != 1) grid[{x, y}] = 1000 * y + x;  // one column of tiles never written
    }
  }
  return grid;
}

TEST(TiledGrid, AroundGivesTheEightNeighboursInsideOfATileAndAcrossItsEdges) {
  const TiledGrid<int> grid = patchwork();
  for (int y = -75; y < 35; ++y) {
    for (int x = -135; x < 25; ++x) {
      const auto around = grid.around({x, y});
      for (std::size_t d = 0; d < kNeighbours.size(); ++d)
        ASSERT_EQ(around[d], grid.at(Cell{x, y} + kNeighbours[d])) << x << ", " << y << ": " << d;
    }
  }
}

TEST(TiledGrid, BesideIsTheNeighbourItself) {
  TiledGrid<int> grid = patchwork();
  for (int y = -75; y < 35; ++y) {
    for (int x = -135; x < 25; ++x) {
      const Cell c{x, y};
      for (const Cell step : kNeighbours)
        ASSERT_EQ(&grid.beside(grid[c], c, step), &grid[c + step]) << x << ", " << y;
    }
  }
}

TEST(TiledGrid, AReaderSeesWhatTheGridHolds) {
  const TiledGrid<int> grid = patchwork();
  TiledGrid<int>::Reader reader(grid);
  std::mt19937 random(1);
  Cell c;
  for (int k = 0; k < 100000; ++k) {
    c = c + kNeighbours[random() % 8];
    if (k % 1000 == 0)
      c = {static_cast<int>(random() % 300) - 200, static_cast<int>(random() % 200)};
    ASSERT_EQ(reader.at(c), grid.at(c)) << c.x << ", " << c.y;
  }
}

}  // namespace
}  // namespace cca
