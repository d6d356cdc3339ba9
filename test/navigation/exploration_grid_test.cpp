// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/world/exploration_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "navigation/world/frontier.hpp"

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
double thickened(double sigma) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, sigma);
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
  return static_cast<double>(occupied) / looked_at;
}

TEST(ExplorationGrid, NoiseOfACentimetreThickensNoWall) { EXPECT_LT(thickened(0.01), 0.01); }

TEST(ExplorationGrid, NoiseOfThreeCentimetresThickensHardlyAnyWall) {
  EXPECT_LT(thickened(0.03), 0.1);
}

/// A full turn in a corridor of 14 x 2 m along x, on its middle line at x.
Scan turnInACorridor(double x, double bearing_sigma, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, bearing_sigma);
  Scan scan;
  scan.angle_increment = M_PI / 270.0;
  scan.T_map_sensor = {x, 0.0, 0.0};
  for (std::size_t k = 0; k < 540; ++k) {
    const double bearing = scan.bearing(k) + noise(random);
    const double end = std::cos(bearing) > 0.0 ? 14.0 - x : x;
    scan.ranges.push_back(
        std::min(end / std::abs(std::cos(bearing)), 1.0 / std::abs(std::sin(bearing))));
  }
  return scan;
}

// Beams that graze a wall go through it where their bearing is not quite what it is thought to be.
TEST(ExplorationGrid, BearingNoiseOpensNoWallThatTheRobotLooksAlong) {
  std::mt19937 random(1);
  ExplorationGrid grid(0.05);
  for (int k = 0; k <= 100; ++k) grid.insert(turnInACorridor(3.0 + 0.08 * k, 0.0087, random));
  for (int k = 0; k < 500; ++k) grid.insert(turnInACorridor(11.0, 0.0087, random));
  int open = 0, behind = 0;
  for (int x = 60; x < 220; ++x) {
    for (const int side : {-21, 20}) {
      open += grid.at({x, side}) != CellState::kOccupied;
      const CellState beyond = grid.at({x, side < 0 ? -25 : 24});
      behind += beyond == CellState::kFree || beyond == CellState::kPresumedFree;
    }
  }
  EXPECT_LE(open, 6);
  EXPECT_EQ(behind, 0);
}

/// A straight wall, seen from its right side (below it where it is not turned).
struct StraightWall {
  Eigen::Vector2d along, away;  ///< unit; away from the sensor
  double offset;                ///< m, of the wall along `away`

  StraightWall(double turn, double wall_offset)
      : along(std::cos(turn), std::sin(turn)),
        away(-std::sin(turn), std::cos(turn)),
        offset(wall_offset) {}
  Eigen::Vector2d at(double x, double behind = 0.0) const {
    return x * along + (offset + behind) * away;
  }
  double behind(const Eigen::Vector2d& p) const { return p.dot(away) - offset; }
};

/// A full turn of 1 degree a beam from x along the wall, `before` it; what is farther than 8 m away
/// does not return. Deviations: m along the beam.
Scan lookAtWall(const StraightWall& wall, double x, double before, double sigma,
                std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  Scan scan;
  scan.angle_increment = M_PI / 180.0;
  scan.free_range_without_return = 8.0;
  scan.T_map_sensor = {wall.at(x, -before).x(), wall.at(x, -before).y(), 0.3};
  for (std::size_t k = 0; k < 360; ++k) {
    const double bearing = 0.3 + scan.bearing(k);
    const double closing = wall.away.dot(Eigen::Vector2d(std::cos(bearing), std::sin(bearing)));
    const double range = closing > 0.0 ? before / closing : kInf;
    scan.ranges.push_back(range < 8.0 ? range + sigma * noise(random) : kInf);
  }
  return scan;
}

/// Of 4 m of a wall, looked at from places along it and then for long from one far end: cm that no
/// wall stands for, seen or between two returns, and cells behind it that seem free.
struct WallFaults {
  int missing = 0, behind = 0;
};

WallFaults faultsOf(const StraightWall& wall, double before, double sigma) {
  std::mt19937 random(1);
  ExplorationGrid grid(0.05);
  for (int k = 0; k <= 20; ++k) grid.insert(lookAtWall(wall, 0.2 * k, before, sigma, random));
  // Without noise the scans are equal, and twelve take evidence from one bound to the other: what
  // more than twice as many would add is nothing.
  const int looks = sigma > 0.0 ? 100 : 25;
  for (int k = 0; k < looks; ++k) grid.insert(lookAtWall(wall, -2.0, before, sigma, random));
  WallFaults faults;
  for (int x = 0; x <= 400; ++x) {
    bool stands = false;
    for (const double deep : {0.0, 0.025, 0.05}) {
      const CellState state = grid.at(grid.cellOf(wall.at(0.01 * x, deep)));
      stands |= state == CellState::kOccupied || state == CellState::kPresumedWall;
    }
    faults.missing += !stands;
  }
  for (int y = grid.lowest().y; y <= grid.highest().y; ++y) {
    for (int x = grid.lowest().x; x <= grid.highest().x; ++x) {
      const bool is_behind = wall.behind(grid.centreOf({x, y})) > 0.05;
      faults.behind += is_behind && isFree(grid.at({x, y}));
    }
  }
  return faults;
}

/// Free cells behind the side wall of a corridor 12 m long and 3 m wide, of a scan whose beams look
/// up to half a spacing aside of their bearings.
int freedBehindAGrazedWall(double told_sigma) {
  Scan scan;
  scan.angle_increment = 0.8 * M_PI / 180.0;
  scan.angle_min = -20.0 * scan.angle_increment;
  scan.T_map_sensor = {0.0, 1.5, 0.0};
  scan.bearing_sigma = told_sigma;
  for (int k = 0; k <= 40; ++k) {
    const double error = (k % 2 ? 0.45 : -0.45) * scan.angle_increment;
    const double bearing = scan.bearing(static_cast<std::size_t>(k)) + error;
    const double along = 12.0 / std::cos(bearing);
    const double to_side = 1.5 / std::max(std::abs(std::sin(bearing)), 1e-9);
    scan.ranges.push_back(std::min(along, to_side));
  }
  ExplorationGrid grid(0.05);
  grid.insert(scan);
  int freed = 0;
  for (int x = 0; x < 240; ++x)
    for (int behind = 2; behind < 12; ++behind)
      freed += (grid.at({x, -behind}) == CellState::kFree) +
               (grid.at({x, 59 + behind}) == CellState::kFree);
  return freed;
}

TEST(ExplorationGrid, BeamsThatLookBesideTheirBearingsFreeNothingBehindAWallThatTheyGraze) {
  EXPECT_GT(freedBehindAGrazedWall(0.0), 5);
  EXPECT_EQ(freedBehindAGrazedWall(0.8 * M_PI / 180.0 / std::sqrt(12.0)), 0);
}

// Real walls lie anywhere within the cells, at any angle: each angle with each offset, from one of
// three distances.
TEST(ExplorationGrid, AWallAnywhereWithinItsCellsIsOccupiedAndHidesWhatIsBehind) {
  constexpr double kBefore[] = {0.3, 1.0, 2.5};  // m
  int tried = 0;
  for (const double turn : {0.0, 0.03, 0.2, 0.5, M_PI / 4.0, 1.2}) {
    for (const double offset : {0.0, 0.01, 0.02, 0.025, 0.03, 0.04, 0.045}) {
      const double before = kBefore[tried++ % 3];
      for (const double sigma : {0.0, 0.01}) {
        const WallFaults faults = faultsOf({turn, 1.0 + offset}, before, sigma);
        const auto where = testing::Message() << "turned by " << turn << ", at " << offset << ", "
                                              << before << " before it, noise " << sigma;
        EXPECT_EQ(faults.missing, 0) << where;
        EXPECT_EQ(faults.behind, 0) << where;
      }
    }
  }
}

/// Cells beside 4 m of a wall, which are free and beside a face that was not seen.
int besideUnseenFaces(const ExplorationGrid& grid, const StraightWall& wall) {
  int cells = 0;
  for (int y = grid.lowest().y - 3; y <= grid.highest().y + 3; ++y) {
    for (int x = grid.lowest().x - 3; x <= grid.highest().x + 3; ++x) {
      const double along = grid.centreOf({x, y}).dot(wall.along);
      cells += along > 0.0 && along < 4.0 && isBesideUnseenFace(grid, {x, y});
    }
  }
  return cells;
}

// A wall of 5 cm, anywhere within its cells: 4 m of it are looked at from one side, then the other.
TEST(ExplorationGrid, KnowsWhichFaceOfAThinWallWasSeen) {
  constexpr double kThick = 0.05;
  for (const double turn : {0.0, 0.03, 0.2, 0.5, M_PI / 4.0}) {
    for (const double offset : {0.004, 0.014, 0.026, 0.04}) {
      for (const double sigma : {0.0, 0.01}) {
        const StraightWall front(turn, 1.0 + offset), back(turn + M_PI, -1.0 - offset - kThick);
        std::mt19937 random(1);
        ExplorationGrid grid(0.05);
        const auto where = testing::Message()
                           << "turned by " << turn << ", at " << offset << ", noise " << sigma;
        for (int k = 0; k <= 20; ++k) grid.insert(lookAtWall(front, 0.2 * k, 1.0, sigma, random));
        EXPECT_EQ(besideUnseenFaces(grid, front), 0) << where;
        const Cell low = grid.lowest() + Cell{-6, -6}, high = grid.highest() + Cell{6, 6};
        for (int y = low.y; y <= high.y; ++y) {
          for (int x = low.x; x <= high.x; ++x) {
            const double behind = front.behind(grid.centreOf({x, y}));
            const bool is_unknown = grid.at({x, y}) == CellState::kUnknown;
            if (is_unknown && behind > 0.02) grid.set({x, y}, CellState::kFree);
          }
        }
        // As many as it has cells: at 45 degrees 56.
        EXPECT_GE(besideUnseenFaces(grid, front), 50) << where;
        for (int k = 0; k <= 20; ++k) grid.insert(lookAtWall(back, -0.2 * k, 1.0, sigma, random));
        EXPECT_LE(besideUnseenFaces(grid, front), 4) << where;
      }
    }
  }
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
