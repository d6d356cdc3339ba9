// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/view_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cca_mrpt/sensing/beam.hpp"
#include "known_world.hpp"

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
  CellSet openings;
  openings.insert(kGap);
  return openings;
}

double gainFrom(const ExplorationGrid& grid, Cell from) {
  return viewFrom(grid, from, kRange, theGap()).gain;
}

TEST(ViewFrom, CutsTheCornersOfAGapButGoesThroughNoWall) {
  const ExplorationGrid open = room(true), shut = room(false);
  // Askew, from both sides, each ray through the gap grazes its jambs.
  EXPECT_GT(gainFrom(open, {7, 28}), 0.0);
  EXPECT_GT(gainFrom(open, {7, 12}), 0.0);
  EXPECT_EQ(unknownAreaInView(open, {7, 28}, kRange), 0.0) << "without cutting";
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

// Rays are left out where no way can be shorter: all of them are asked here.
TEST(NearestViewPoint, IsThePlaceOfTheShortestWayOnAnyRay) {
  ExplorationGrid grid = randomWorld(4, 160, 0.002).seen();
  FreeSpace space(0.25, grid.resolution());
  space.update(grid, grid.changed());
  std::mt19937 random(5);
  DistanceField field;
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    const auto anywhere = [&] {
      return Cell{static_cast<int>(random() % 160), static_cast<int>(random() % 160)};
    };
    field.search(space, grid.resolution(), anywhere());
    const Cell target = anywhere();
    const CellState was = grid.at(target);
    grid.set(target, CellState::kUnknown);
    double least = DistanceField::kUnreached;
    for (const Eigen::Vector2d& direction : directionsAround(90, M_PI / 90)) {
      walkBeam(middleOf(target), direction, kRange / grid.resolution(), [&](Cell c, double) {
        if (grid.at(c) == CellState::kOccupied) return false;
        if (space.isTraversable(c) && c != target) least = std::min(least, field.distanceTo(c));
        return true;
      });
    }
    const auto view = nearestViewPoint(grid, space, field, ScannedPlaces{}, target, kRange);
    grid.set(target, was);
    EXPECT_EQ(view ? view->distance : DistanceField::kUnreached, least);
    found += view.has_value();
  }
  EXPECT_GT(found, 100);
}

TEST(IsInView, EndsAtWallsAndSoonBehindWhatIsKnown) {
  const ExplorationGrid grid = room(true);
  const Cell from{20, 20};
  const auto deepest = static_cast<int>(kThroughUnknown / grid.resolution());
  EXPECT_TRUE(isInView(grid, from, from));
  EXPECT_TRUE(isInView(grid, from, {1, 30}));
  EXPECT_TRUE(isInView(grid, from, kGap + Cell{-deepest, 0}));
  EXPECT_FALSE(isInView(grid, from, kGap + Cell{-deepest - 2, 0}));
  EXPECT_FALSE(isInView(grid, from, kGap + Cell{-1, 5})) << "behind the wall";
}

TEST(EachBlockInView, FindsThePlacesThatAnOpeningIsSeenFrom) {
  const ExplorationGrid grid = room(true);
  std::vector<Cell> blocks;
  eachBlockInView(grid, kGap, kRange, [&](Cell block) { blocks.push_back(block); });
  const auto isInView = [&](Cell c) {
    return std::find(blocks.begin(), blocks.end(), FreeSpace::blockOf(c)) != blocks.end();
  };
  for (int y = 1; y < kSide - 1; ++y) {
    for (int x = 1; x < kSide - 1; ++x) {
      const bool sees = gainFrom(grid, {x, y}) > 0.0;
      EXPECT_TRUE(!sees || isInView({x, y})) << x << ", " << y;
    }
  }
  EXPECT_TRUE(isInView({7, 28}));
  EXPECT_FALSE(isInView({1, 1})) << "along the wall";
}

}  // namespace
}  // namespace cca::view_points_test
