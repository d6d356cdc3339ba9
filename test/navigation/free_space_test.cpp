// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/world/free_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "known_world.hpp"

namespace cca {
namespace {

constexpr double kSide = 0.05;  // m, of a cell

/// The definition, cell by cell: distance from the centre to the nearest point of any obstacle.
bool isTraversableByDefinition(const ExplorationGrid& grid, Cell c, double clearance) {
  if (grid.at(c) != CellState::kFree) return false;
  constexpr int kReach = 10;
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx) {
      if (grid.at({c.x + dx, c.y + dy}) != CellState::kOccupied) continue;
      const double gap_x = std::max(std::abs(dx) - 0.5, 0.0) * grid.resolution();
      const double gap_y = std::max(std::abs(dy) - 0.5, 0.0) * grid.resolution();
      if (std::hypot(gap_x, gap_y) < clearance - 1e-9) return false;
    }
  }
  return true;
}

/// @param isOpen  bool(Cell). Single cells and whole blocks say the same.
template <class IsOpen>
void expectOpen(const FreeSpace& space, int side, IsOpen&& isOpen) {
  for (int y = -2; y < side + 2; ++y) {
    for (int x = -2; x < side + 2; ++x) {
      const Cell c{x, y};
      const bool expected = isOpen(c);
      ASSERT_EQ(space.isTraversable(c), expected) << x << ", " << y;
      const unsigned bits = space.traversableCells(FreeSpace::blockOf(c));
      ASSERT_EQ((bits & FreeSpace::bitOf(c)) != 0, expected) << x << ", " << y;
    }
  }
}

void expectEqualsDefinition(const FreeSpace& space, const ExplorationGrid& grid, int side,
                            double clearance) {
  expectOpen(space, side, [&](Cell c) { return isTraversableByDefinition(grid, c, clearance); });
}

/// Cells that are set one by one.
struct SetCells {
  ExplorationGrid grid;
  FreeSpace space{0.25, grid.resolution()};

  void set(Cell c, CellState state) {
    grid.set(c, state);
    space.update(grid, {c});
  }
};

TEST(FreeSpace, KeepsTheClearanceFromEveryOccupiedCell) {
  const ExplorationGrid grid = randomWorld(1, 60, 0.01).seen();
  FreeSpace space(0.30, grid.resolution());
  space.update(grid, grid.changed());
  expectEqualsDefinition(space, grid, 60, 0.30);
}

// 55 cm for a robot that needs 53 cm: one noisy cell on either side, and it stays open.
TEST(FreeSpace, APassageThatWasOpenStaysSoWithANoisyCellOnBothSides) {
  ExplorationGrid grid;
  std::vector<Cell> all;
  for (int y = 0; y < 13; ++y) {
    all.push_back({0, y});
    grid.set({0, y}, y % 12 ? CellState::kFree : CellState::kOccupied);
  }
  FreeSpace space(0.266, grid.resolution());
  space.update(grid, all);
  EXPECT_TRUE(space.isTraversable({0, 6}));
  for (const Cell noisy : {Cell{0, 1}, Cell{0, 11}}) {
    grid.set(noisy, CellState::kOccupied);
    space.update(grid, {noisy});
    EXPECT_TRUE(space.isTraversable({0, 6}));
  }
  grid.set({0, 2}, CellState::kOccupied);
  space.update(grid, {{0, 2}});
  EXPECT_FALSE(space.isTraversable({0, 6}));
}

// What is free is often seen before the wall beside it.
TEST(FreeSpace, AnOpenCellShutsBesideAWallThatIsSeenLater) {
  SetCells cells;
  const FreeSpace& space = cells.space;
  cells.set({0, 0}, CellState::kFree);
  for (const int y : {-1, 0, 1}) {
    cells.set({5, y}, CellState::kOccupied);  // .225 m, for a clearance of .25
    EXPECT_TRUE(space.isTraversable({0, 0}));
  }
  cells.set({5, -2}, CellState::kOccupied);
  EXPECT_FALSE(space.isTraversable({0, 0}));
}

TEST(FreeSpace, AnOpenCellShutsWhereAnObstacleComesNearerByACell) {
  SetCells cells;
  const FreeSpace& space = cells.space;
  cells.set({0, 0}, CellState::kFree);
  cells.set({5, 0}, CellState::kOccupied);  // .225 m from the centre
  EXPECT_TRUE(space.isTraversable({0, 0}));
  cells.set({4, 0}, CellState::kOccupied);  // .175 m
  EXPECT_FALSE(space.isTraversable({0, 0}));
  cells.set({4, 0}, CellState::kFree);
  EXPECT_FALSE(space.isTraversable({0, 0})) << "it opens where the clearance is kept";
  cells.set({5, 0}, CellState::kFree);
  EXPECT_TRUE(space.isTraversable({0, 0}));
}

// A robot of two metres in a saved map of filled walls: more obstacles within reach than 12 bits
// count.
TEST(FreeSpace, CountsThousandsOfObstaclesWithinItsClearance) {
  ExplorationGrid grid;
  std::vector<Cell> all;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 80; ++x) {
      all.push_back({x, y});
      grid.set({x, y}, x == 40 && y == 40 ? CellState::kFree : CellState::kOccupied);
    }
  }
  FreeSpace space(2.0, grid.resolution());
  space.update(grid, all);
  EXPECT_FALSE(space.isTraversable({40, 40}));
  for (const Cell c : all) grid.set(c, CellState::kFree);
  space.update(grid, all);
  for (const Cell c : all) ASSERT_TRUE(space.isTraversable(c)) << c.x << ", " << c.y;
}

TEST(FreeSpace, StaysBetweenItsBoundsWhileCellsChangeBackAndForth) {
  ExplorationGrid grid = randomWorld(2, 40, 0.01).seen();
  FreeSpace space(0.25, grid.resolution());
  space.update(grid, grid.changed());
  std::mt19937 random(3);
  constexpr CellState kStates[] = {CellState::kUnknown, CellState::kFree, CellState::kOccupied};
  for (int i = 0; i < 400; ++i) {
    const FreeSpace before = space;
    std::vector<Cell> changed;
    // One alone, or as many as a scan may change, some of them more than once.
    for (int k = 0; k < (i % 2 ? 50 : 1); ++k) {
      changed.push_back({static_cast<int>(random() % 40), static_cast<int>(random() % 40)});
      grid.set(changed.back(), kStates[random() % 3]);
    }
    space.update(grid, changed);
    expectOpen(space, 40, [&](Cell c) {
      return isTraversableByDefinition(grid, c, 0.25) ||
             (before.isTraversable(c) && isTraversableByDefinition(grid, c, 0.25 - kSide));
    });
  }
}

TEST(FreeSpace, WhereTheRobotHasBeenStaysOpenUntilTheCellItselfIsOccupied) {
  SetCells cells;
  const FreeSpace& space = cells.space;
  cells.set({0, 0}, CellState::kFree);
  cells.space.pass({0, 0});
  cells.set({2, 0}, CellState::kOccupied);  // within the clearance
  EXPECT_TRUE(space.isTraversable({0, 0}));
  EXPECT_TRUE(space.traversableCells({0, 0}) & FreeSpace::bitOf({0, 0}));
  cells.set({0, 0}, CellState::kOccupied);
  EXPECT_FALSE(space.isTraversable({0, 0}));
  EXPECT_FALSE(space.traversableCells({0, 0}) & FreeSpace::bitOf({0, 0}));
  cells.set({0, 0}, CellState::kFree);  // what stood there has gone
  EXPECT_TRUE(space.isTraversable({0, 0}));
  // Beside the robot's way the clearance counts.
  cells.set({1, 0}, CellState::kFree);
  EXPECT_FALSE(space.isTraversable({1, 0}));
}

// Somebody stands beside the robot's former way: its hull is no longer free there.
TEST(FreeSpace, WhereTheRobotHasBeenShutsWhileSomebodyStandsWhereItsHullWas) {
  SetCells cells;
  const FreeSpace& space = cells.space;
  cells.set({0, 0}, CellState::kFree);
  cells.space.pass({0, 0});
  for (int k = 0; k < 8; ++k) {
    cells.set({2 + k % 3, k / 3 - 1}, CellState::kOccupied);
    EXPECT_TRUE(space.isTraversable({0, 0})) << "may be a wall that is drawn beside its place";
  }
  cells.set({4, 1}, CellState::kOccupied);
  EXPECT_FALSE(space.isTraversable({0, 0}));
  EXPECT_EQ(space.passedCells({0, 0}), 0u);
  cells.set({4, 1}, CellState::kFree);
  EXPECT_TRUE(space.isTraversable({0, 0}));
}

// A wall that is drawn half a cell too near does not shut a passage that the robot came through.
TEST(FreeSpace, WhereTheRobotHasBeenStaysOpenBetweenWallsWithinTheClearance) {
  SetCells cells;
  cells.set({0, 0}, CellState::kFree);
  cells.space.pass({0, 0});
  for (int x = -5; x <= 5; ++x) {
    for (const int y : {-5, 5}) cells.set({x, y}, CellState::kOccupied);  // .225 m, for .25
  }
  EXPECT_TRUE(cells.space.isTraversable({0, 0}));
}

TEST(FreeSpace, HoldsNothingBeforeAnythingIsKnown) {
  const FreeSpace space(0.3, 0.05);
  EXPECT_FALSE(space.isTraversable({0, 0}));
  EXPECT_EQ(space.traversableCells({0, 0}), 0u);
}

}  // namespace
}  // namespace cca
