// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/view_tour.hpp"

#include <gtest/gtest.h>

#include <random>

#include "known_world.hpp"

namespace cca {
namespace {

constexpr double kReach = 0.2;  // m: each view point sees its own target only

/// Squares of half a metre: rooms along both sides of a corridor of 19 m.
const KnownWorld kRooms{
    {"#########################################", "#......#......#......#......#......#....#",
     "#......#......#......#......#......#....#", "#......#......#......#......#......#....#",
     "###..#####..#####..#####..#####..#####..#", "#.......................................#",
     "#.......................................#", "##..#####..#####..#####..#####..#####..##",
     "#......#......#......#......#......#....#", "#......#......#......#......#......#....#",
     "#......#......#......#......#......#....#", "#########################################"},
    10};
constexpr Cell kRobot{205, 60};  // in the middle of the corridor

struct Rooms {
  ExplorationGrid grid = kRooms.seen();
  FreeSpace space{0.27, grid.resolution()};
  DistanceField ways;
  Rooms() {
    space.update(grid, grid.changed());
    ways.search(space, grid.resolution(), kRobot);
  }

  ViewPoint at(Cell cell, double gain) const { return {cell, cell, ways.distanceTo(cell), gain}; }

  std::vector<ViewPoint> randomViews(unsigned seed, int count) const {
    std::mt19937 random(seed);
    std::vector<ViewPoint> views;
    while (static_cast<int>(views.size()) < count) {
      const Cell c{static_cast<int>(random() % static_cast<unsigned>(kRooms.width())),
                   static_cast<int>(random() % static_cast<unsigned>(kRooms.height()))};
      if (ways.isReached(c)) views.push_back(at(c, 0.1 * static_cast<double>(1 + random() % 100)));
    }
    return views;
  }
};

ViewTour shortest() {
  ViewTourParameters parameters;
  parameters.hurry = 0.0;
  return ViewTour(parameters);
}

TEST(ViewTour, ChoosesNoneOfNone) {
  const Rooms rooms;
  EXPECT_FALSE(ViewTour{}.choose(rooms.grid, rooms.space, {}, kReach, {}, false));
}

// Two views in a room nearby, three in one farther off.
TEST(ViewTour, FinishesWhatIsNearBeforeItGoesFar) {
  const Rooms rooms;
  const std::vector<ViewPoint> views{rooms.at({380, 15}, 1.0), rooms.at({360, 15}, 1.0),
                                     rooms.at({240, 20}, 1.0), rooms.at({260, 20}, 1.0),
                                     rooms.at({385, 20}, 1.0)};
  const auto first = shortest().choose(rooms.grid, rooms.space, views, kReach, {}, false);
  ASSERT_TRUE(first);
  EXPECT_TRUE(*first == 2 || *first == 3) << *first;
}

// Half a metre from the robot, nine metres to the other side, and a look at nothing.
TEST(ViewTour, LeavesWhatIsNotWorthItsWay) {
  const Rooms rooms;
  ViewTourParameters parameters;
  parameters.worth = 5.0;
  const auto choose = [&](const std::vector<ViewPoint>& views, bool only_rests) {
    return ViewTour(parameters).choose(rooms.grid, rooms.space, views, kReach, {}, only_rests);
  };
  const ViewPoint near = rooms.at({215, 60}, 0.2), far = rooms.at({25, 60}, 1.0);
  EXPECT_EQ(choose({far, near}, false), 1u);
  EXPECT_FALSE(choose({far}, false));
  parameters.worth = 20.0;
  EXPECT_EQ(choose({far}, false), 0u);
  EXPECT_FALSE(choose({far}, true)) << "all around it is known";
}

// Two goals as far off as each other: the present one is kept. Not so where the other one is near.
TEST(ViewTour, KeepsThePresentGoalWhereAnotherTourIsHardlyCheaper) {
  const Rooms rooms;
  const std::vector<ViewPoint> views{rooms.at({105, 60}, 1.0), rooms.at({305, 60}, 1.0)};
  for (const std::size_t present : {0u, 1u}) {
    EXPECT_EQ(
        shortest().choose(rooms.grid, rooms.space, views, kReach, views[present].target, false),
        present);
  }
  const std::vector<ViewPoint> uneven{rooms.at({105, 60}, 1.0), rooms.at({245, 60}, 1.0)};
  EXPECT_EQ(shortest().choose(rooms.grid, rooms.space, uneven, kReach, uneven[0].target, false),
            1u);
}

TEST(ViewTour, WhatIsPreparedIsNotEstimated) {
  const Rooms rooms;
  ViewTourParameters none, all;
  none.fields_per_choice = 0;
  all.fields_per_choice = 100;
  int differ = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const auto views = rooms.randomViews(seed, 8);
    ViewTour exact(all), prepared(none);
    const auto choose = [&](ViewTour& tour) {
      return tour.choose(rooms.grid, rooms.space, views, kReach, {}, false);
    };
    const auto best = choose(exact);
    differ += choose(prepared) != best;
    for (std::size_t i = 0; i < views.size(); ++i) prepared.prepare(rooms.grid, rooms.space);
    EXPECT_EQ(choose(prepared), best) << seed;
  }
  EXPECT_GT(differ, 0) << "the estimates are as good";
}

}  // namespace
}  // namespace cca
