// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/barred_ways.hpp"

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
  ways.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, space);
  for (int x = 15; x < 45; ++x) {
    EXPECT_EQ(space.isTraversable({x, 40}), x < 18 || x > 34) << x;
    EXPECT_EQ(space.isTraversable({x, 42}), x < 18 || x > 34) << x;
    EXPECT_TRUE(space.isTraversable({x, 43})) << x;
  }
}

TEST_F(OpenFloor, AWayIsBarredAroundItsCorners) {
  ways.bar({{1.025, 2.025}, {1.225, 2.025}, {1.225, 3.0}}, kResolution, space);
  EXPECT_FALSE(space.isTraversable({24, 47}));
  EXPECT_TRUE(space.isTraversable({28, 40}));
}

TEST_F(OpenFloor, WhereTheRobotHasBeenStaysOpen) {
  space.pass({25, 40});
  ways.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, space);
  EXPECT_TRUE(space.isTraversable({25, 40}));
  EXPECT_FALSE(space.isTraversable({26, 40}));
}

TEST_F(OpenFloor, WhatWasBarredTwiceStaysShutWhenTheLastIsOpened) {
  ways.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, space);
  const int once = shut();
  ways.bar({{1.225, 2.025}, {3.025, 2.025}}, kResolution, space);
  EXPECT_GT(shut(), once);
  ways.openLast(space);
  EXPECT_EQ(shut(), once);
  EXPECT_TRUE(ways.openAll(space));
  EXPECT_EQ(shut(), 0);
  EXPECT_FALSE(ways.openAll(space));
  ways.openLast(space);
  EXPECT_EQ(shut(), 0);
}

TEST_F(OpenFloor, WaysWithoutLengthAndBeyondTheGridBarNothing) {
  ways.bar({}, kResolution, space);
  ways.bar({{1.0, 1.0}}, kResolution, space);
  ways.bar({{1.0, 1.0}, {1.0, 1.0}}, kResolution, space);
  ways.bar({{1e4, 1e4}, {1e4, 2e4}}, kResolution, space);
  EXPECT_EQ(shut(), 0);
}

}  // namespace
}  // namespace cca
