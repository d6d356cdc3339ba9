// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/failed_tries.hpp"

#include <gtest/gtest.h>

namespace cca::failed_tries_test {
namespace {

TEST(FailedTries, ATargetIsAsideUntilTenSquareMetresHaveBeenSeen) {
  for (const Failure failure : {Failure::kNothingSeen, Failure::kNotReached}) {
    FailedTries tries;
    EXPECT_TRUE(tries.add({10, 10}, failure, 500));
    EXPECT_TRUE(tries.isAside({10, 10}, 500));
    EXPECT_TRUE(tries.isAside({10, 10}, 4499));
    EXPECT_FALSE(tries.isAside({10, 10}, 4500));
  }
}

TEST(FailedTries, NeighboursAreTheSameTarget) {
  FailedTries tries;
  tries.add({10, 10}, Failure::kNotReached, 0);
  EXPECT_TRUE(tries.isAside({13, 7}, 0));
  EXPECT_FALSE(tries.isAside({14, 10}, 0));
}

TEST(FailedTries, TheSecondLostWaySetsATargetAside) {
  FailedTries tries;
  EXPECT_FALSE(tries.add({10, 10}, Failure::kWayLost, 0));
  EXPECT_FALSE(tries.add({20, 20}, Failure::kWayLost, 0));
  EXPECT_FALSE(tries.isAside({10, 10}, 0)) << "lost is not yet aside";
  EXPECT_TRUE(tries.add({12, 9}, Failure::kWayLost, 0));
  EXPECT_TRUE(tries.isAside({12, 9}, 0));
  EXPECT_FALSE(tries.isAside({20, 20}, 0));
}

TEST(FailedTries, CountHowOftenInARowTheRobotWasHeldAtOnePlace) {
  FailedTries tries;
  const Cell here{0, 0}, beside{4, 4}, elsewhere{7, 0};
  EXPECT_EQ(tries.timesHeld(), 0);
  tries.add({50, 0}, Failure::kNotReached, 0, elsewhere);
  tries.add({10, 0}, Failure::kNotReached, 0, here);
  tries.add({20, 0}, Failure::kWayLost, 0, here);
  EXPECT_EQ(tries.timesHeld(), 1) << "a way lost once is no failure yet";
  tries.add({20, 0}, Failure::kWayLost, 0, beside);
  tries.add({30, 0}, Failure::kNotReached, 0);
  EXPECT_EQ(tries.timesHeld(), 2);
  tries.add({40, 0}, Failure::kNothingSeen, 0);
  EXPECT_EQ(tries.timesHeld(), 0) << "it got away";
}

constexpr double kResolution = 0.05;

/// 4 x 4 m, all free.
struct OpenFloor : ::testing::Test {
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
  FailedTries tries;
};

TEST_F(OpenFloor, TheFirstSixtyCentimetresOfAWayAreBarred) {
  tries.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 0, space);
  for (int x = 15; x < 45; ++x) {
    EXPECT_EQ(space.isTraversable({x, 40}), x < 18 || x > 34) << x;
    EXPECT_EQ(space.isTraversable({x, 42}), x < 18 || x > 34) << x;
    EXPECT_TRUE(space.isTraversable({x, 43})) << x;
  }
}

TEST_F(OpenFloor, AWayIsBarredAroundItsCorners) {
  tries.bar({{1.025, 2.025}, {1.225, 2.025}, {1.225, 3.0}}, kResolution, 0, space);
  EXPECT_FALSE(space.isTraversable({24, 47}));
  EXPECT_TRUE(space.isTraversable({28, 40}));
}

TEST_F(OpenFloor, WhereTheRobotHasBeenStaysOpen) {
  space.pass({25, 40});
  tries.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 0, space);
  EXPECT_TRUE(space.isTraversable({25, 40}));
  EXPECT_FALSE(space.isTraversable({26, 40}));
}

TEST_F(OpenFloor, WhereTheRobotWasHeldSixTimesStaysShutUntilTheMapHasChanged) {
  const std::vector<Eigen::Vector2d> here{{1.025, 2.025}, {3.025, 2.025}},
      beside{{1.225, 2.025}, {3.025, 2.025}}, elsewhere{{1.025, 3.025}, {3.025, 3.025}};
  EXPECT_FALSE(tries.open(0, space));
  int once = 0;
  for (int k = 0; k < 5; ++k) {
    tries.bar(k % 2 ? beside : here, kResolution, 0, space);
    if (k == 0) once = shut();
    EXPECT_TRUE(tries.open(0, space));
    EXPECT_EQ(shut(), 0);
    EXPECT_FALSE(tries.open(0, space)) << "all are open";
  }
  tries.bar(here, kResolution, 0, space);
  EXPECT_FALSE(tries.open(0, space));
  tries.bar(elsewhere, kResolution, 0, space);
  EXPECT_EQ(shut(), 2 * once);
  EXPECT_TRUE(tries.open(0, space));
  EXPECT_EQ(shut(), once);
  EXPECT_FALSE(tries.open(3999, space));
  EXPECT_TRUE(tries.open(4000, space));
  EXPECT_EQ(shut(), 0);
}

TEST_F(OpenFloor, WaysWithoutLengthAndBeyondTheGridBarNothing) {
  tries.bar({}, kResolution, 0, space);
  tries.bar({{1.0, 1.0}}, kResolution, 0, space);
  tries.bar({{1.0, 1.0}, {1.0, 1.0}}, kResolution, 0, space);
  tries.bar({{1e4, 1e4}, {1e4, 2e4}}, kResolution, 0, space);
  EXPECT_EQ(shut(), 0);
}

TEST_F(OpenFloor, AllOfItGoesAlongWhereTheMapIsMadeAnew) {
  tries.add({10, 10}, Failure::kNotReached, 500);
  tries.bar({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 0, space);
  FreeSpace anew(0.25, kResolution);
  ExplorationGrid same = grid;
  std::vector<Cell> all;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 80; ++x) all.push_back({x, y});
  }
  anew.update(same, all);
  tries.move([](Cell c) { return c + Cell{0, 20}; }, 100, anew);
  EXPECT_TRUE(tries.isAside({10, 30}, 100));
  EXPECT_FALSE(tries.isAside({10, 10}, 100));
  EXPECT_FALSE(tries.isAside({10, 30}, 4100)) << "as if it had failed when the map was made";
  EXPECT_TRUE(anew.isTraversable({26, 40}));
  EXPECT_FALSE(anew.isTraversable({26, 60}));
}

}  // namespace
}  // namespace cca::failed_tries_test
