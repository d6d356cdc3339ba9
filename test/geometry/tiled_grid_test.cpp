// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/geometry/tiled_grid.hpp"

#include <gtest/gtest.h>

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

TEST(TiledGrid, HoldsWhatWasWrittenAndIsBlankElsewhere) {
  const TiledGrid<int> grid = patchwork();
  for (int y = -75; y < 35; ++y) {
    for (int x = -135; x < 25; ++x) {
      const bool is_written = y >= -70 && y < 30 && x >= -130 && x < 20 && (x + 130) / 64 != 1;
      ASSERT_EQ(grid.at({x, y}), is_written ? 1000 * y + x : -1) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace cca
