// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/view_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "known_world.hpp"
#include "sensing/beam.hpp"

namespace cca::view_points_test {
namespace {

constexpr double kRange = 4.0;
constexpr int kSide = 40;
constexpr Cell kGap{0, 20};

/// A free square behind a wall of one cell (x = 0), beyond which nothing is known.
ExplorationGrid room(bool has_gap) {
  ExplorationGrid grid;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool is_rim = x == 0 || y == 0 || x == kSide - 1 || y == kSide - 1;
      grid.set({x, y}, is_rim ? CellState::kOccupied : CellState::kFree);
    }
  }
  if (has_gap) grid.set(kGap, CellState::kFree);
  return grid;
}

CellSet theGap() {
  CellSet frontier_cells;
  frontier_cells.insert(kGap);
  return frontier_cells;
}

double gainFrom(const ExplorationGrid& grid, Cell from) {
  return viewFrom(grid, from, kRange, theGap()).gain;
}

TEST(ViewFrom, CutsTheCornersOfAGapButGoesThroughNoWall) {
  const ExplorationGrid open = room(true), shut = room(false);
  // Askew, from both sides, each ray through the gap grazes its jambs.
  EXPECT_GT(gainFrom(open, {7, 28}), 0.0);
  EXPECT_GT(gainFrom(open, {7, 12}), 0.0);
  CellSet everywhere;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) everywhere.insert({x, y});
  }
  for (int y = 1; y < kSide - 1; ++y) {
    for (int x = 1; x < kSide - 1; ++x)
      ASSERT_EQ(viewFrom(shut, {x, y}, kRange, everywhere).gain, 0.0) << x << ", " << y;
  }
}

TEST(ViewFrom, CountsOnlyWhatLiesBehindAnOpening) {
  const ExplorationGrid grid = room(true);
  EXPECT_GT(gainFrom(grid, {10, 20}), 0.0);
  EXPECT_EQ(viewFrom(grid, {10, 20}, kRange, CellSet{}).gain, 0.0);
}

// What a ray is expected to see of u metres of the unknown is 1 - exp(-u).
TEST(ViewFrom, ExpectsLittleMoreOfALongWedgeThanOfItsFirstMetres) {
  ExplorationGrid short_wedge = room(true);
  for (int y = -20; y < 60; ++y) short_wedge.set({-40, y}, CellState::kOccupied);
  const Cell from{10, 20};
  const ViewPoint near = viewFrom(short_wedge, from, 8.0, theGap()),
                  far = viewFrom(room(true), from, 8.0, theGap());
  EXPECT_GT(far.gain, 3.0 * near.gain);
  EXPECT_GT(far.expected, near.expected);
  EXPECT_LT(far.expected, 2.0 * near.expected);
  EXPECT_LT(near.expected, near.gain);
}

// A wall of one cell through a room of 3 x 2 m. Of the floor behind it all is known.
TEST(ViewFrom, PromisesTheFaceOfAWallThatWasNotSeenUntilItIs) {
  KnownWorld world{std::vector<std::string>(40, "#" + std::string(58, '.') + "#")};
  world.rows.front() = world.rows.back() = std::string(60, '#');
  KnownScene place;
  place.world.seed(world.walls(), CellState::kOccupied);
  for (std::string& row : world.rows) row[30] = '#';
  place.world.seed(world.freeCells(), CellState::kFree);
  place.world.observe(world.scanFrom({0.76, 1.01, 0.3}, 4.0), {0.76, 1.01});
  const auto promiseFrom = [&](Cell from) {
    return viewFrom(place.world.grid(), from, 4.0, place.world.usefulFrontierCells(5));
  };
  const Cell near{15, 20}, beyond{45, 20};
  EXPECT_EQ(promiseFrom(near).gain, 0.0) << "the wall's own side was seen";
  const ViewPoint view = promiseFrom(beyond);
  EXPECT_NEAR(view.gain, 0.3, 0.1);  // a fifth of a square metre for a metre across the view
  EXPECT_NEAR(view.expected, 0.1 * 1.5, 0.05);
  EXPECT_TRUE(place.world.isUnseen(view.target));
  EXPECT_EQ(view.target.x, 31);
  place.world.observe(world.scanFrom({2.26, 1.01, 0.3}, 4.0), {2.26, 1.01});
  EXPECT_EQ(promiseFrom(beyond).gain, 0.0);
  EXPECT_FALSE(place.world.isUnseen(view.target));
}

TEST(ScoreOf, OrdersPlacesAsEachStrategySaysItDoes) {
  const Cell c{0, 0};
  const ViewPoint much_far{c, c, 20.0, 40.0, 4.0}, little_near{c, c, 2.0, 1.0, 0.9},
      wedge{c, c, 4.0, 20.0, 0.5};
  const auto prefers = [](Strategy strategy, const ViewPoint& a, const ViewPoint& b) {
    return scoreOf(strategy, a) > scoreOf(strategy, b);
  };
  EXPECT_TRUE(prefers(Strategy::kGreedy, much_far, wedge));
  EXPECT_TRUE(prefers(Strategy::kNearestFrontier, little_near, wedge));
  EXPECT_TRUE(prefers(Strategy::kGainDistance, wedge, much_far));
  EXPECT_TRUE(prefers(Strategy::kGainDistance, much_far, little_near));
  EXPECT_TRUE(prefers(Strategy::kInformation, much_far, little_near));
  EXPECT_TRUE(prefers(Strategy::kViewTour, little_near, much_far));
  EXPECT_TRUE(prefers(Strategy::kViewTour, little_near, wedge));
}

TEST(IsInView, EndsAtWallsAndSoonBehindWhatIsKnown) {
  const ExplorationGrid grid = room(true);
  const Cell from{20, 20};
  const auto deepest = static_cast<int>(kThroughUnknown / grid.resolution());
  EXPECT_TRUE(isInView(grid, from, from, kRange));
  EXPECT_TRUE(isInView(grid, from, {1, 30}, kRange));
  EXPECT_FALSE(isInView(grid, from, {1, 30}, 0.1)) << "too far";
  EXPECT_TRUE(isInView(grid, from, kGap + Cell{-deepest, 0}, kRange));
  EXPECT_FALSE(isInView(grid, from, kGap + Cell{-deepest - 2, 0}, kRange));
  EXPECT_FALSE(isInView(grid, from, kGap + Cell{-1, 5}, kRange)) << "behind the wall";
}

}  // namespace
}  // namespace cca::view_points_test
