// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/goal_blacklist.hpp"

#include <gtest/gtest.h>

namespace cca::goal_blacklist_test {
namespace {

TEST(GoalBlacklist, ATargetIsBlacklistedUntilTenSquareMetresHaveBeenSeen) {
  for (const Failure failure : {Failure::kNothingSeen, Failure::kNotReached}) {
    GoalBlacklist tries;
    EXPECT_TRUE(tries.add({10, 10}, failure, 500));
    EXPECT_TRUE(tries.contains({10, 10}, 500));
    EXPECT_TRUE(tries.contains({10, 10}, 4499));
    EXPECT_FALSE(tries.contains({10, 10}, 4500));
  }
}

TEST(GoalBlacklist, NeighboursAreTheSameTarget) {
  GoalBlacklist tries;
  tries.add({10, 10}, Failure::kNotReached, 0);
  EXPECT_TRUE(tries.contains({13, 7}, 0));
  EXPECT_FALSE(tries.contains({14, 10}, 0));
}

TEST(GoalBlacklist, TheSecondLostWayBlacklistsATarget) {
  GoalBlacklist tries;
  EXPECT_FALSE(tries.add({10, 10}, Failure::kPathLost, 0));
  EXPECT_FALSE(tries.add({20, 20}, Failure::kPathLost, 0));
  EXPECT_FALSE(tries.contains({10, 10}, 0)) << "lost is not yet aside";
  EXPECT_TRUE(tries.add({12, 9}, Failure::kPathLost, 0));
  EXPECT_TRUE(tries.contains({12, 9}, 0));
  EXPECT_FALSE(tries.contains({20, 20}, 0));
}

TEST(GoalBlacklist, CountHowOftenInARowTheRobotWasHeldAtOnePlace) {
  GoalBlacklist tries;
  const Cell here{0, 0}, beside{4, 4}, elsewhere{7, 0};
  EXPECT_EQ(tries.timesHeld(), 0);
  tries.add({50, 0}, Failure::kNotReached, 0, elsewhere);
  tries.add({10, 0}, Failure::kNotReached, 0, here);
  tries.add({20, 0}, Failure::kPathLost, 0, here);
  EXPECT_EQ(tries.timesHeld(), 1) << "a way lost once is no failure yet";
  tries.add({20, 0}, Failure::kPathLost, 0, beside);
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
      for (int x = 0; x < 80; ++x) cells += !isTraversable({x, y});
    }
    return cells;
  }

  bool isTraversable(Cell c) const {
    return PassableSpace(space, tries.blocked()).isTraversable(c);
  }

  ExplorationGrid grid;
  FreeSpace space{0.25, kResolution};
  GoalBlacklist tries;
};

TEST_F(OpenFloor, TheFirstSixtyCentimetresOfAWayAreBlocked) {
  tries.blockPath({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 0);
  for (int x = 15; x < 45; ++x) {
    EXPECT_EQ(isTraversable({x, 40}), x < 18 || x > 34) << x;
    EXPECT_EQ(isTraversable({x, 42}), x < 18 || x > 34) << x;
    EXPECT_TRUE(isTraversable({x, 43})) << x;
  }
}

TEST_F(OpenFloor, APathIsBlockedAroundItsCorners) {
  tries.blockPath({{1.025, 2.025}, {1.225, 2.025}, {1.225, 3.0}}, kResolution, 0);
  EXPECT_FALSE(isTraversable({24, 47}));
  EXPECT_TRUE(isTraversable({28, 40}));
}

TEST_F(OpenFloor, WhereTheRobotHasBeenStaysOpen) {
  space.pass({25, 40});
  tries.blockPath({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 0);
  EXPECT_TRUE(isTraversable({25, 40}));
  EXPECT_FALSE(isTraversable({26, 40}));
}

TEST_F(OpenFloor, WhereTheRobotWasHeldSixTimesStaysBlockedUntilTheMapHasChanged) {
  const std::vector<Eigen::Vector2d> here{{1.025, 2.025}, {3.025, 2.025}},
      beside{{1.225, 2.025}, {3.025, 2.025}}, elsewhere{{1.025, 3.025}, {3.025, 3.025}};
  EXPECT_FALSE(tries.unblock(0));
  int once = 0;
  for (int k = 0; k < 5; ++k) {
    tries.blockPath(k % 2 ? beside : here, kResolution, 0);
    if (k == 0) once = shut();
    EXPECT_TRUE(tries.unblock(0));
    EXPECT_EQ(shut(), 0);
    EXPECT_FALSE(tries.unblock(0)) << "all are open";
  }
  tries.blockPath(here, kResolution, 0);
  EXPECT_FALSE(tries.unblock(0));
  tries.blockPath(elsewhere, kResolution, 0);
  EXPECT_EQ(shut(), 2 * once);
  EXPECT_TRUE(tries.unblock(0));
  EXPECT_EQ(shut(), once);
  EXPECT_FALSE(tries.unblock(3999));
  EXPECT_TRUE(tries.unblock(4000));
  EXPECT_EQ(shut(), 0);
}

TEST_F(OpenFloor, WaysWithoutLengthAndBeyondTheGridBlockNothing) {
  tries.blockPath({}, kResolution, 0);
  tries.blockPath({{1.0, 1.0}}, kResolution, 0);
  tries.blockPath({{1.0, 1.0}, {1.0, 1.0}}, kResolution, 0);
  tries.blockPath({{1e4, 1e4}, {1e4, 2e4}}, kResolution, 0);
  EXPECT_EQ(shut(), 0);
}

TEST_F(OpenFloor, AllOfItGoesAlongWhereTheMapIsMadeAnew) {
  tries.add({10, 10}, Failure::kNotReached, 500);
  tries.blockPath({{1.025, 2.025}, {3.025, 2.025}}, kResolution, 0);
  tries.addExhausted({60, 10});
  tries.reindex([](Cell c) { return c + Cell{0, 20}; }, 100);
  EXPECT_TRUE(tries.contains({10, 30}, 100));
  EXPECT_FALSE(tries.contains({10, 10}, 100));
  EXPECT_FALSE(tries.contains({10, 30}, 4100)) << "as if it had failed when the map was made";
  EXPECT_TRUE(isTraversable({26, 40}));
  EXPECT_FALSE(isTraversable({26, 60}));
  EXPECT_TRUE(tries.isExhausted({60, 30}));
  EXPECT_FALSE(tries.isExhausted({60, 10}));
}

TEST(GoalBlacklist, AllOfABlockIsExhausted) {
  GoalBlacklist tries;
  tries.addExhausted({-7, 3});
  EXPECT_TRUE(tries.isExhausted({-7, 3}));
  EXPECT_TRUE(tries.isExhausted({-6, 2}));
  EXPECT_FALSE(tries.isExhausted({-4, 3}));
}

}  // namespace
}  // namespace cca::goal_blacklist_test
