// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/world/grid_paths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <queue>

#include "known_world.hpp"

namespace cca {
namespace {

constexpr double kResolution = 0.05;

struct Known {
  ExplorationGrid grid;
  FreeSpace space;
  Known(const KnownWorld& world, double clearance)
      : grid(world.seen()), space(clearance, kResolution) {
    space.update(grid, grid.changed());
  }
};

/// Plain 4-connected flood over cells.
std::map<std::pair<int, int>, bool> reachedByFlood(const FreeSpace& space, Cell start) {
  std::map<std::pair<int, int>, bool> reached;
  std::queue<Cell> open;
  open.push(start);
  reached[{start.x, start.y}] = true;
  while (!open.empty()) {
    const Cell c = open.front();
    open.pop();
    for (std::size_t d = 0; d < 4; ++d) {
      const Cell next = c + kNeighbours[d];
      if (!space.isTraversable(next) || reached[{next.x, next.y}]) continue;
      reached[{next.x, next.y}] = true;
      open.push(next);
    }
  }
  return reached;
}

TEST(DistanceField, ReachesWhatAFloodOverCellsReaches) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const KnownWorld world = randomWorld(seed, 80, 0.012);
    const Known known(world, 0.2);
    Cell start;
    if (!nearestTraversable(known.space, {40, 40}, 20, start)) continue;
    DistanceField field;
    field.search(known.space, kResolution, start);
    auto reached = reachedByFlood(known.space, field.start());
    int differ = 0, cells = 0;
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 80; ++x) {
        if (!known.space.isTraversable({x, y})) continue;
        ++cells;
        differ += field.isReached({x, y}) != reached[{x, y}];
      }
    }
    EXPECT_EQ(differ, 0) << "of " << cells << ", seed " << seed;
  }
}

/// Costs over whole blocks, in twelfths of a side, by plain repetition until nothing gets shorter.
std::map<std::pair<int, int>, int> shortestOverBlocks(const KnownWorld& blocks, Cell start) {
  const auto isOpen = [&](Cell c) { return !blocks.isOccupied(c); };
  std::map<std::pair<int, int>, int> cost{{{start.x, start.y}, 0}};
  std::queue<Cell> open;
  open.push(start);
  for (; !open.empty(); open.pop()) {
    const Cell c = open.front();
    for (std::size_t d = 0; d < 8; ++d) {
      const Cell step = kNeighbours[d], next = c + step;
      if (!isOpen(next) || !isOpen({c.x + step.x, c.y}) || !isOpen({c.x, c.y + step.y})) continue;
      const int way = cost[{c.x, c.y}] + (d < 4 ? 12 : 17);
      const auto known = cost.find({next.x, next.y});
      if (known != cost.end() && known->second <= way) continue;
      cost[{next.x, next.y}] = way;
      open.push(next);
    }
  }
  return cost;
}

TEST(DistanceField, IsThatOfTheShortestOfAllPathsOverBlocks) {
  for (const double share : {0.0, 0.02, 0.1, 0.3}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      KnownWorld world = randomWorld(seed, 40, share);
      const Cell start{20, 17};
      world.rows[39 - 17][20] = '.';
      auto shortest = shortestOverBlocks(world, start);
      world.scale = FreeSpace::kBlock;
      const Known known(world, 0.01);
      DistanceField field;
      field.search(known.space, kResolution, {20 * FreeSpace::kBlock, 17 * FreeSpace::kBlock});
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
          const double way = field.distanceTo({FreeSpace::kBlock * x, FreeSpace::kBlock * y});
          const auto cost = shortest.find({x, y});
          ASSERT_EQ(cost == shortest.end(), way == DistanceField::kUnreached) << x << ", " << y;
          if (cost == shortest.end()) continue;
          ASSERT_NEAR(way, cost->second * 0.2 / 12.0, 1e-9) << x << ", " << y;
        }
      }
    }
  }
}

TEST(DistanceField, MeasuresStraightWaysExactlyAndObliqueOnesWithinEightPercent) {
  const Known known({std::vector<std::string>(100, std::string(100, '.'))}, 0.1);
  DistanceField field;
  field.search(known.space, kResolution, {10, 10});
  EXPECT_NEAR(field.distanceTo({90, 10}), 4.0, 1e-9);
  for (int k = 0; k <= 80; k += 8) {
    const double line = std::hypot(80, k) * kResolution;
    EXPECT_GE(field.distanceTo({90, 10 + k}), line - 0.2);
    EXPECT_LE(field.distanceTo({90, 10 + k}), 1.083 * line + 0.2);
  }
}

TEST(DistanceField, DoesNotCrossAWallOneCellThin) {
  KnownWorld world{std::vector<std::string>(40, std::string(40, '.'))};
  for (auto& row : world.rows) row[20] = '#';
  const Known known(world, 0.01);
  DistanceField field;
  field.search(known.space, kResolution, {5, 5});
  EXPECT_TRUE(field.isReached({19, 30}));
  EXPECT_FALSE(field.isReached({21, 30}));
}

// Noise may leave the cell of a robot in a corner open by itself.
TEST(DistanceField, BeginsBesideASingleCellThatLeadsNowhere) {
  Known known({std::vector<std::string>(20, std::string(20, '.'))}, 0.27);
  known.space.pass({2, 2});
  DistanceField field;
  field.search(known.space, kResolution, {2, 2});
  EXPECT_EQ(field.start(), (Cell{5, 5}));
  EXPECT_TRUE(field.isReached({14, 14}));
}

// A small robot in a cupboard of its own is not outside of it.
TEST(DistanceField, DoesNotBeginBehindAWall) {
  const Known known({{"............", "............", "............", "............",  //
                      "###.........", "..#.........", "..#.........", "..#........."},
                     1},
                    0.01);
  ASSERT_TRUE(known.space.isTraversable({1, 1}));
  DistanceField field;
  field.search(known.space, kResolution, {1, 1});
  EXPECT_EQ(field.start(), (Cell{1, 1}));
  EXPECT_FALSE(field.isStarted()) << "no way leads half a metre away";
  EXPECT_FALSE(field.isReached({11, 7}));
}

TEST(DistanceField, StopsAtTheCellThatWasAskedForWithTheSamePath) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Known known(randomWorld(seed, 160, 0.01), 0.2);
    Cell start, goal;
    if (!nearestTraversable(known.space, {40, 40}, 20, start)) continue;
    if (!nearestTraversable(known.space, {90, 70}, 20, goal)) continue;
    DistanceField whole, part;
    whole.search(known.space, kResolution, start);
    part.search(known.space, kResolution, start, goal);
    EXPECT_EQ(part.distanceTo(goal), whole.distanceTo(goal));
    EXPECT_EQ(part.blocksTo(goal), whole.blocksTo(goal));
    int farther = 0;
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 160; ++x) {
        if (!part.isReached({x, y})) continue;
        EXPECT_EQ(part.distanceTo({x, y}), whole.distanceTo({x, y}));
        farther += part.distanceTo({x, y}) > part.distanceTo(goal);
      }
    }
    EXPECT_EQ(farther, 0);
  }
}

TEST(DistanceField, ReachesNothingFromWithinAWall) {
  const Known known({std::vector<std::string>(40, std::string(40, '#'))}, 0.1);
  DistanceField field;
  field.search(known.space, kResolution, {20, 20});
  EXPECT_FALSE(field.isStarted());
  EXPECT_FALSE(field.isReached({20, 20}));
  EXPECT_TRUE(shortestPath(known.space, kResolution, field, {20, 20}).empty());
}

TEST(ShortestPath, IsOneLineInTheOpen) {
  const Known known({std::vector<std::string>(100, std::string(100, '.'))}, 0.1);
  DistanceField field;
  field.search(known.space, kResolution, {10, 10});
  const auto path = shortestPath(known.space, kResolution, field, {80, 47});
  ASSERT_EQ(path.size(), 2u);
  EXPECT_NEAR(pathLength(path), kResolution * std::hypot(70, 37), 1e-9);
}

TEST(ShortestPath, GoesRoundAWallByItsEndAndKeepsClear) {
  KnownWorld world{std::vector<std::string>(100, std::string(100, '.'))};
  for (std::size_t row = 30; row < 100; ++row) world.rows[row][50] = '#';  // up to y = 3.5 m
  const Known known(world, 0.25);
  DistanceField field;
  field.search(known.space, kResolution, {20, 20});
  const auto path = shortestPath(known.space, kResolution, field, {80, 20});
  ASSERT_GE(path.size(), 3u);
  for (std::size_t i = 1; i < path.size(); ++i)
    EXPECT_TRUE(isClearLine(known.space, path[i - 1] / kResolution, path[i] / kResolution));
  // Tangents to the corner, grown by the clearance: at least to it, at most 25 cm and cells beyond.
  const double least = 2.0 * std::hypot(1.5, 2.5);
  EXPECT_GT(pathLength(path), least);
  EXPECT_LT(pathLength(path), least + 2.0 * 0.4);
}

TEST(IsClearLine, DoesNotSlipBetweenTwoCellsThatTouchAtACorner) {
  KnownWorld world{std::vector<std::string>(20, std::string(20, '.'))};
  const auto block = [&](int x, int y) {
    world.rows[static_cast<std::size_t>(19 - y)][static_cast<std::size_t>(x)] = '#';
  };
  block(10, 9);
  block(9, 10);
  const Known known(world, 0.01);
  EXPECT_FALSE(isClearLine(known.space, {8.5, 8.5}, {12.5, 12.5}));
  EXPECT_TRUE(isClearLine(known.space, {8.5, 8.5}, {9.4, 9.4}));
}

}  // namespace
}  // namespace cca
