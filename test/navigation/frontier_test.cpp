// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/world/frontier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "known_world.hpp"

namespace cca {
namespace {

using Places = std::set<std::pair<int, int>>;

Places asSet(const std::vector<Cell>& cells) {
  Places set;
  for (const Cell c : cells) set.insert({c.x, c.y});
  return set;
}

TEST(FrontierCells, EqualAFullRecomputationAfterEveryScan) {
  KnownWorld world = randomWorld(7, 120, 0.003);
  ExplorationGrid grid;
  FrontierCells frontier;
  for (int i = 0; i < 12; ++i) {
    grid.insert(world.scanFrom({1.0 + 0.3 * i, 1.5 + 0.2 * i, 0.1 * i}, 2.5));
    frontier.update(grid, grid.changed());
    Places expected;
    for (int y = -2; y < 125; ++y) {
      for (int x = -2; x < 125; ++x) {
        if (isFrontier(grid, {x, y})) expected.insert({x, y});
      }
    }
    ASSERT_EQ(asSet(frontier.cells()), expected) << "scan " << i;
    ASSERT_EQ(frontier.cells().size(), expected.size()) << "scan " << i;
  }
}

TEST(FrontierCells, AreNoneInAPlaceThatIsKnownCompletely) {
  const ExplorationGrid grid = randomWorld(7, 40, 0.01).seen();
  FrontierCells frontier;
  frontier.update(grid, grid.changed());
  EXPECT_TRUE(frontier.cells().empty());
  EXPECT_TRUE(frontier.frontiers(40).empty());
}

TEST(FrontierCells, AreGroupedIntoAPartitionOfNoMoreThanTheExtent) {
  ExplorationGrid grid;
  for (int x = 0; x < 100; ++x) grid.set({x, 0}, CellState::kFree);  // one line, 100 cells
  FrontierCells cells;
  cells.update(grid, grid.changed());
  const auto frontiers = cells.frontiers(30);
  EXPECT_GE(frontiers.size(), 4u);
  Places all;
  std::size_t count = 0;
  for (const Frontier& f : frontiers) {
    const auto [low, high] = std::minmax_element(f.cells.begin(), f.cells.end(),
                                                 [](Cell a, Cell b) { return a.x < b.x; });
    EXPECT_LE(high->x - low->x, 30);
    EXPECT_TRUE(cells.all().contains(f.middle));
    count += f.cells.size();
    for (const Cell c : f.cells) all.insert({c.x, c.y});
  }
  EXPECT_EQ(count, 100u);
  EXPECT_EQ(all.size(), 100u);
}

TEST(FrontierCells, AtTheEndOfTheRangeDoNotFallToPiecesBetweenTheBeams) {
  for (const double range : {4.0, 8.0, 20.0}) {
    Scan scan;
    scan.ranges.assign(361, std::numeric_limits<double>::infinity());
    scan.angle_min = -M_PI;
    scan.angle_increment = 2.0 * M_PI / 360.0;
    scan.free_range_without_return = range;
    scan.T_map_sensor = {0.01, 0.02, 0.003};
    ExplorationGrid grid;
    grid.insert(scan);
    FrontierCells cells;
    cells.update(grid, grid.changed());
    std::size_t in_pieces = 0;
    for (const Frontier& f : cells.frontiers(40))
      in_pieces += f.cells.size() < 5 ? f.cells.size() : 0;
    EXPECT_LT(in_pieces, cells.cells().size() / 20) << "range " << range;
  }
}

}  // namespace
}  // namespace cca
