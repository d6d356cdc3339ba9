// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/exploration_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cca {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Scan oneBeam(double range, double free_range = 0.0) {
  Scan scan;
  scan.ranges = {range};
  scan.free_range_without_return = free_range;
  scan.T_map_sensor = {0.025, 0.025, 0.0};
  return scan;
}

TEST(ExplorationGrid, FreesTheCellsBeforeAReturnAndOccupiesTheOneBehindIt) {
  ExplorationGrid grid(0.05);
  grid.insert(oneBeam(0.975));  // to x = 1.0, the face of cell 20
  for (int x = 0; x < 20; ++x) EXPECT_EQ(grid.at({x, 0}), CellState::kFree) << x;
  EXPECT_EQ(grid.at({20, 0}), CellState::kOccupied);
  EXPECT_EQ(grid.at({21, 0}), CellState::kUnknown);
  EXPECT_EQ(grid.at({5, 1}), CellState::kUnknown);
  EXPECT_EQ(grid.changed().size(), 21u);
}

TEST(ExplorationGrid, FreesABeamWithoutReturnOnlyAsFarAsIsSaid) {
  ExplorationGrid silent(0.05), open(0.05);
  silent.insert(oneBeam(kInf, 0.0));
  EXPECT_TRUE(silent.changed().empty());
  open.insert(oneBeam(kInf, 2.0));
  EXPECT_EQ(open.at({40, 0}), CellState::kFree);
  EXPECT_EQ(open.at({41, 0}), CellState::kUnknown);
}

TEST(ExplorationGrid, ForgetsWhatHasMovedAway) {
  ExplorationGrid grid(0.05);
  for (int i = 0; i < 50; ++i) grid.insert(oneBeam(0.975));
  for (int i = 0; i < 8; ++i) grid.insert(oneBeam(1.975));
  EXPECT_EQ(grid.at({20, 0}), CellState::kFree);
  EXPECT_EQ(grid.at({40, 0}), CellState::kOccupied);
}

// A robot that stands beside a passage has several beams in each cell of its walls, and one of them
// would be enough to count for the cell in front.
TEST(ExplorationGrid, NoiseOfACentimetreThickensNoWall) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  ExplorationGrid grid(0.05);
  int occupied = 0, looked_at = 0;
  for (int scans = 0; scans < 200; ++scans) {
    Scan scan;
    scan.angle_min = -0.7;
    scan.angle_increment = M_PI / 180.0;
    scan.T_map_sensor = {0.5, 0.025, 0.0};
    for (int k = 0; k <= 80; ++k)  // a wall with its face at x = 1, that of cell 20
      scan.ranges.push_back(0.5 / std::cos(scan.bearing(static_cast<std::size_t>(k))) +
                            noise(random));
    grid.insert(scan);
    for (int y = -6; y <= 6; ++y) {
      ++looked_at;
      occupied += grid.at({19, y}) == CellState::kOccupied;
      EXPECT_EQ(grid.at({20, y}), CellState::kOccupied) << y;
    }
  }
  EXPECT_LT(occupied, 0.01 * looked_at);
}

TEST(ExplorationGrid, LeavesInvalidRangesAndPosesAlone) {
  ExplorationGrid grid(0.05);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -kInf, 0.0, -1.0}) {
    grid.insert(oneBeam(bad, 5.0));
    EXPECT_TRUE(grid.changed().empty()) << bad;
  }
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInf, 1e12}) {
    Scan scan = oneBeam(1.0);
    scan.T_map_sensor.x = bad;
    grid.insert(scan);
    EXPECT_TRUE(grid.changed().empty()) << bad;
  }
  grid.insert(Scan{});
  EXPECT_TRUE(grid.changed().empty());
}

TEST(ExplorationGrid, PresumesAWallBetweenTwoReturnsOfOneSurface) {
  // A wall at x = 8: beams 1 degree apart hit it every 14 cm.
  Scan scan;
  scan.angle_increment = 3.14159265358979 / 180.0;
  scan.angle_min = -10 * scan.angle_increment;
  for (int i = 0; i <= 20; ++i) scan.ranges.push_back(7.99 / std::cos(scan.bearing(i)));
  scan.T_map_sensor = {0.01, 0.025, 0.0};
  ExplorationGrid grid(0.05);
  grid.insert(scan);
  for (int y = -25; y <= 25; ++y) {
    const CellState state = grid.at({160, y});
    EXPECT_TRUE(state == CellState::kOccupied || state == CellState::kPresumedWall)
        << y << " is " << static_cast<int>(state);
  }
}

}  // namespace
}  // namespace cca
