// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/barred_ways.hpp"

#include <gtest/gtest.h>

namespace cca {
namespace {

constexpr double kResolution = 0.05;

/// 4 x 4 m, all free.
struct OpenFloor : testing::Test {
  OpenFloor() {
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 80; ++x) grid.set({x, y}, CellState::kFree);
    }
    space.update(grid, grid.changed());
  }

  int shut() const {
    int cells = 0;
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 80; ++x) cells += !space.isTraversable({x, y});
    }
    return cells;
  }

  ExplorationGrid grid;
  FreeSpace space{0.25, kResolution};
  BarredWays ways;
};

TEST_F(OpenFloor, TheFirstSixtyCentimetresOfAWayAreBarred) {
  ways.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 0, space);
  for (int x = 15; x < 45; ++x) {
    EXPECT_EQ(space.isTraversable({x, 40}), x < 18 || x > 34) << x;
    EXPECT_EQ(space.isTraversable({x, 42}), x < 18 || x > 34) << x;
    EXPECT_TRUE(space.isTraversable({x, 43})) << x;
  }
}

TEST_F(OpenFloor, AWayIsBarredAroundItsCorners) {
  ways.bar({{1.025, 2.025}, {1.225, 2.025}, {1.225, 3.0}}, kResolution, 0, space);
  EXPECT_FALSE(space.isTraversable({24, 47}));
  EXPECT_TRUE(space.isTraversable({28, 40}));
}

TEST_F(OpenFloor, WhereTheRobotHasBeenStaysOpen) {
  space.pass({25, 40});
  ways.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 0, space);
  EXPECT_TRUE(space.isTraversable({25, 40}));
  EXPECT_FALSE(space.isTraversable({26, 40}));
}

TEST_F(OpenFloor, BarredWaysAreRecalledOnlyAfterSomethingNewWasSeen) {
  ways.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 1000, space);
  EXPECT_FALSE(ways.recall(1200, space));
  EXPECT_FALSE(space.isTraversable({25, 40}));
  EXPECT_TRUE(ways.recall(1201, space));
  EXPECT_EQ(shut(), 0);
  EXPECT_FALSE(ways.recall(9999, space));
}

TEST_F(OpenFloor, WhatWasBarredTwiceStaysShutUntilBothAreOpen) {
  ways.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 1000, space);
  const int once = shut();
  ways.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 2000, space);
  EXPECT_TRUE(ways.recall(1500, space));
  EXPECT_EQ(shut(), once);
  EXPECT_TRUE(ways.openAll(space));
  EXPECT_EQ(shut(), 0);
  EXPECT_FALSE(ways.openAll(space));
}

TEST_F(OpenFloor, WaysWithoutLengthAndBeyondTheGridBarNothing) {
  ways.bar({}, kResolution, 0, space);
  ways.bar({{1.0, 1.0}}, kResolution, 0, space);
  ways.bar({{1.0, 1.0}, {1.0, 1.0}}, kResolution, 0, space);
  ways.bar({{1e4, 1e4}, {1e4, 2e4}}, kResolution, 0, space);
  EXPECT_EQ(shut(), 0);
}

}  // namespace
}  // namespace cca
