// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/view_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "known_world.hpp"

namespace cca {
namespace {

/// Squares of 40 cm: a room, and another one behind a gap that no robot fits through.
const KnownWorld kRoomBehindAGap{
    {"###################", "#.......#.........#", "#.......#.........#", "#.......#.........#",
     "#.................#", "#.......#.........#", "#.......#.........#", "#.......#.........#",
     "###################"},
    8};
const Eigen::Vector2d kBeforeTheGap{2.6, 1.8};

constexpr double kPriceless = 1e3;  // m/m^2: worth any way

/// Calls until all places have been asked.
std::optional<ViewPoint> nextOf(ViewSearch& view_search, KnownScene& place, Strategy strategy,
                                const ViewSearch::Filter& filter) {
  auto view = view_search.next(place.scene, strategy, filter);
  while (!view && view_search.isUnderWay()) view = view_search.next(place.scene, strategy, filter);
  return view;
}

struct Look {
  KnownScene place;
  ViewSearch view_search{0.1, 5, kPriceless};

  explicit Look(const Eigen::Vector2d& robot = kBeforeTheGap) {
    place.world.observe(kRoomBehindAGap.scanFrom({robot.x(), robot.y(), 0.0}), robot);
    place.scene.findPaths(robot);
  }
  std::optional<ViewPoint> next(Strategy strategy, const ViewSearch::Filter& filter = takesAll) {
    return nextOf(view_search, place, strategy, filter);
  }
  static bool takesAll(const ViewPoint&) { return true; }
  /// m^2 that a place promises behind frontiers of five cells and more.
  double gainFrom(Cell from) {
    return viewFrom(place.world.grid(), from, place.world.laserRange(),
                    place.world.usefulFrontierCells(5))
        .gain;
  }
};

TEST(ViewSearch, FindsReachedPlacesThatSeeMoreThroughAGap) {
  Look look;
  const auto view = look.next(Strategy::kGreedy);
  ASSERT_TRUE(view);
  EXPECT_TRUE(look.place.scene.distances().isReached(view->cell));
  EXPECT_EQ(look.place.world.grid().at(view->target), CellState::kUnknown);
  EXPECT_GT(look.place.world.grid().centreOf(view->target).x(), 3.4) << "behind the gap";
  // What was promised is seen from there.
  EXPECT_NEAR(look.gainFrom(view->cell), view->gain, 1e-9);
  const Eigen::Vector2d there = look.place.world.grid().centreOf(view->cell);
  const std::size_t before = look.place.world.grid().revealed();
  look.place.world.observe(kRoomBehindAGap.scanFrom({there.x(), there.y(), 0.0}), there);
  // Beside each of the two posts of the gap a ray may go between two beams of the scan.
  const double one_ray = M_PI / 360.0 * std::pow(look.place.world.laserRange(), 2);
  EXPECT_LT(look.gainFrom(view->cell), 2.0 * one_ray);
  EXPECT_GT(look.place.world.grid().revealed(), before + 200);
}

// A drive from place to place ends, and then no place sees more than was asked for.
TEST(ViewSearch, EndsWhenNoPlaceSeesMore) {
  Look look;
  int looks = 0;
  for (; const auto view = look.next(Strategy::kNearestFrontier); ++looks) {
    ASSERT_LT(looks, 50);
    const Eigen::Vector2d there = look.place.world.grid().centreOf(view->cell);
    look.place.world.observe(kRoomBehindAGap.scanFrom({there.x(), there.y(), 0.0}), there);
    look.place.scene.findPaths(there);
  }
  EXPECT_GT(looks, 1) << "a single place does not see it all";
  for (const Cell c : kRoomBehindAGap.freeCells()) {
    const Cell block = FreeSpace::blockOf(c);
    const bool is_first = c.x % FreeSpace::kBlock == 0 && c.y % FreeSpace::kBlock == 0;
    if (!is_first || look.place.world.space().traversableCells(block) != 0xFFFF) continue;
    if (!look.place.scene.distances().isReached(c) || look.place.scene.isExhausted(c)) continue;
    EXPECT_LT(look.gainFrom(c), 0.1) << c.x << ", " << c.y;
  }
}

TEST(ViewSearch, LeavesOutWhatTheFilterRefuses) {
  Look look;
  const auto refuses_above = [&](const ViewPoint& view) {
    return look.place.world.grid().centreOf(view.cell).y() < 1.8;
  };
  for (int k = 0; k < 20; ++k) {
    const auto view = look.next(Strategy::kGreedy, refuses_above);
    ASSERT_TRUE(view);
    EXPECT_LT(look.place.world.grid().centreOf(view->cell).y(), 1.8);
  }
  EXPECT_FALSE(look.next(Strategy::kGreedy, [](const ViewPoint&) { return false; }));
}

// What is behind a wall that lacks a few cells would be a promise that is never kept.
TEST(ViewSearch, ExpectsNothingBehindASmallFrontier) {
  KnownScene place;
  std::vector<Cell> walls = kRoomBehindAGap.walls(), room;
  for (const Cell c : kRoomBehindAGap.freeCells()) {
    if (c.x < 64) room.push_back(c);
  }
  for (int y = 32; y < 37; ++y) walls.push_back({64, y});  // three cells of the gap are left
  place.world.seed(walls, CellState::kOccupied);
  place.world.seed(room, CellState::kFree);
  place.scene.findPaths(kBeforeTheGap);
  for (const std::size_t smallest : {std::size_t{3}, std::size_t{5}}) {
    ViewSearch view_search(0.1, smallest, kPriceless);
    const auto view = nextOf(view_search, place, Strategy::kGreedy, Look::takesAll);
    EXPECT_EQ(view.has_value(), smallest == 3);
  }
}

struct Corridor {
  KnownScene place;
  ViewSearch view_search{0.1, 5, kPriceless};
  std::vector<std::size_t> slots;

  Corridor() {
    for (std::size_t x = 5; x < 100; x += 6) slots.push_back(x);
    showCorridor(place.world, slots);
    place.scene.findPaths({10.0, 1.0});
  }
};

TEST(ViewSearch, WhatIsSeenInPassingLiesOnTheWayAndIsNotSeenFromItsEnd) {
  Corridor corridor;
  const KnownScene& place = corridor.place;
  nextOf(corridor.view_search, corridor.place, Strategy::kGreedy, Look::takesAll);
  corridor.view_search.next(place.scene, Strategy::kViewTour, Look::takesAll);
  const double robot_x = 10.0;
  int found = 0;
  for (const ViewPoint& goal :
       corridor.view_search.nextBest(Strategy::kViewTour, Look::takesAll, {}, 12)) {
    const auto passed = corridor.view_search.onTheWay(place.scene, Look::takesAll, goal);
    if (!passed) continue;
    ++found;
    const double line = distanceBetween(passed->cell, goal.cell) * place.world.grid().resolution();
    EXPECT_LT(passed->distance, goal.distance);
    EXPECT_LE(passed->distance + line, goal.distance + 1.0);
    EXPECT_FALSE(isInView(place.world.grid(), goal.cell, passed->target, place.world.laserRange()));
    const double x = place.world.grid().centreOf(passed->cell).x();
    EXPECT_EQ(x > robot_x, place.world.grid().centreOf(goal.cell).x() > robot_x);
    EXPECT_FALSE(corridor.view_search.onTheWay(
        place.scene, [](const ViewPoint&) { return false; }, goal));
  }
  EXPECT_GT(found, 1);
}

TEST(ViewSearch, GoesThroughALargePlaceAFewAtATime) {
  const KnownWorld hall{std::vector<std::string>(30, std::string(30, '.')), 10};
  KnownScene place;
  place.world.seed(hall.freeCells(), CellState::kFree);  // nothing is known of what is around it
  place.scene.findPaths({7.5, 7.5});
  ViewSearch view_search(0.1, 5, kPriceless);
  int calls = 0;
  while (!view_search.next(place.scene, Strategy::kGreedy, Look::takesAll) &&
         view_search.isUnderWay())
    ++calls;
  EXPECT_GT(calls, 5) << "of 1400 places";
  EXPECT_LT(calls, 50);
}

// While one seems better than any farther off can be, these are not asked; when it proves worse,
// they are, however little has been seen since all were asked.
TEST(ViewSearch, AsksThoseFartherOffWhenTheBestProvesWorse) {
  const auto block = [](int from, int to, int low, int high) {
    std::vector<Cell> cells;
    for (int x = from; x < to; ++x) {
      for (int y = low; y < high; ++y) cells.push_back({x, y});
    }
    return cells;
  };
  KnownScene place;
  place.world.seed(block(0, 20, 0, 20), CellState::kFree);
  place.scene.findPaths({0.5, 0.5});
  ViewSearch view_search(0.1, 5, kPriceless);
  ASSERT_FALSE(
      nextOf(view_search, place, Strategy::kViewTour, [](const ViewPoint&) { return false; }));
  ASSERT_FALSE(view_search.left().empty());
  // Presumed only, so nothing is seen: walls around it, and a corridor whose far end is open.
  for (const int y : {-1, 20}) place.world.seed(block(-1, 250, y, y + 1), CellState::kPresumedWall);
  place.world.seed(block(-1, 0, 0, 20), CellState::kPresumedWall);
  place.world.seed(block(20, 300, 0, 20), CellState::kPresumedFree);
  place.scene.findPaths({0.5, 0.5});
  const auto view = nextOf(view_search, place, Strategy::kViewTour,
                           [](const ViewPoint& v) { return v.gain >= 1.0 || v.cell.x >= 260; });
  ASSERT_TRUE(view);
  EXPECT_GT(view->cell.x, 240);
}

TEST(ViewSearch, LeavesWhatIsNotWorthItsWay) {
  Look look;
  look.view_search = ViewSearch(0.1, 5, 0.1);  // m/m^2
  EXPECT_FALSE(look.next(Strategy::kGreedy));
  EXPECT_FALSE(look.view_search.isUnderWay());
  ASSERT_FALSE(look.view_search.left().empty());
  EXPECT_GT(look.view_search.left().front().expected, 0.0);
}

TEST(ViewSearch, FindsNothingBeforeItBeginsOrWhereAllIsKnown) {
  ViewSearch view_search(0.1, 5, kPriceless);
  KnownScene nowhere;
  EXPECT_FALSE(view_search.next(nowhere.scene, Strategy::kGreedy, Look::takesAll));
  EXPECT_FALSE(view_search.next(nowhere.scene, Strategy::kGreedy, Look::takesAll));
  EXPECT_FALSE(view_search.isUnderWay());
  Look look;
  look.place.world.seed(kRoomBehindAGap.walls(), CellState::kOccupied);
  look.place.world.seed(kRoomBehindAGap.freeCells(), CellState::kFree);
  EXPECT_FALSE(look.next(Strategy::kGreedy));
}

}  // namespace
}  // namespace cca
