// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/view_tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "known_world.hpp"

namespace cca::view_tour_test {
namespace {

using Stops = std::vector<std::size_t>;

double costOf(const Eigen::MatrixXd& distance, const std::vector<double>& urgency,
              const Stops& stops) {
  double length = 0.0, waiting = 0.0;
  Eigen::Index from = 0;
  for (const std::size_t stop : stops) {
    length += distance(from, static_cast<Eigen::Index>(stop) + 1);
    waiting += urgency[stop] * length;
    from = static_cast<Eigen::Index>(stop) + 1;
  }
  return length + waiting;
}

/// Of all orders that begin with each stop.
std::vector<double> leastCosts(const Eigen::MatrixXd& distance,
                               const std::vector<double>& urgency) {
  Stops stops(urgency.size());
  std::iota(stops.begin(), stops.end(), 0u);
  std::vector<double> least(stops.size(), std::numeric_limits<double>::infinity());
  do {
    double& of_first = least[stops.front()];
    of_first = std::min(of_first, costOf(distance, urgency, stops));
  } while (std::next_permutation(stops.begin(), stops.end()));
  return least;
}

std::size_t bestFirst(const Eigen::MatrixXd& distance, const std::vector<double>& urgency) {
  const auto costs = tourCosts(distance, urgency);
  return static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}

TEST(Tours, AreTheBestOfAllOrdersThatBeginWithEachStop) {
  constexpr int kStops = 7;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.0, 20.0);
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i <= kStops; ++i) points.emplace_back(place(random), place(random));
    Eigen::MatrixXd distance(kStops + 1, kStops + 1);
    for (std::size_t i = 0; i <= kStops; ++i) {
      for (std::size_t j = 0; j <= kStops; ++j)
        distance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            (points[i] - points[j]).norm();
    }
    for (const double hurry : {0.0, 1.0, 10.0}) {
      std::vector<double> urgency;
      for (int i = 0; i < kStops; ++i) urgency.push_back(hurry * place(random) / 20.0 / kStops);
      const auto costs = tourCosts(distance, urgency), least = leastCosts(distance, urgency);
      ASSERT_EQ(costs.size(), least.size());
      for (std::size_t first = 0; first < costs.size(); ++first)
        EXPECT_NEAR(costs[first], least[first], 1e-9) << seed << ' ' << hurry;
    }
  }
}

TEST(Tours, ServeTheUrgentStopFirst) {
  // On a line: one 1 m to the left, one 2 m to the right.
  Eigen::MatrixXd distance(3, 3);
  distance << 0, 1, 2, 1, 0, 3, 2, 3, 0;
  EXPECT_EQ(bestFirst(distance, {0.0, 0.0}), 0u);
  EXPECT_EQ(bestFirst(distance, {1.0, 9.0}), 1u);
}

TEST(Tours, OfNoStopsAreNone) { EXPECT_TRUE(tourCosts(Eigen::MatrixXd::Zero(1, 1), {}).empty()); }

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

  /// A metre apart at least: nearer ones share the ways from one of them.
  std::vector<ViewPoint> randomViews(unsigned seed, int count) const {
    std::mt19937 random(seed);
    std::vector<ViewPoint> views;
    while (static_cast<int>(views.size()) < count) {
      const Cell c{static_cast<int>(random() % static_cast<unsigned>(kRooms.width())),
                   static_cast<int>(random() % static_cast<unsigned>(kRooms.height()))};
      const double gain = 0.1 * static_cast<double>(1 + random() % 100);
      const bool is_apart = std::all_of(views.begin(), views.end(), [c](const ViewPoint& view) {
        return distanceBetween(view.cell, c) >= 20.0;
      });
      if (ways.isReached(c) && is_apart) views.push_back(at(c, gain));
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
  EXPECT_FALSE(ViewTour{}.choose(rooms.grid, rooms.space, {}, kReach, {}));
}

// Two views in a room nearby, three in one farther off.
TEST(ViewTour, FinishesWhatIsNearBeforeItGoesFar) {
  const Rooms rooms;
  const std::vector<ViewPoint> views{rooms.at({380, 15}, 1.0), rooms.at({360, 15}, 1.0),
                                     rooms.at({240, 20}, 1.0), rooms.at({260, 20}, 1.0),
                                     rooms.at({385, 20}, 1.0)};
  const auto first = shortest().choose(rooms.grid, rooms.space, views, kReach, {});
  ASSERT_TRUE(first);
  EXPECT_TRUE(*first == 2 || *first == 3) << *first;
}

// Two goals as far off as each other: the present one is kept. Not so where the other one is near.
TEST(ViewTour, KeepsThePresentGoalWhereAnotherTourIsHardlyCheaper) {
  const Rooms rooms;
  const std::vector<ViewPoint> views{rooms.at({105, 60}, 1.0), rooms.at({305, 60}, 1.0)};
  for (const std::size_t present : {0u, 1u}) {
    EXPECT_EQ(shortest().choose(rooms.grid, rooms.space, views, kReach, views[present].target),
              present);
  }
  const std::vector<ViewPoint> uneven{rooms.at({105, 60}, 1.0), rooms.at({245, 60}, 1.0)};
  EXPECT_EQ(shortest().choose(rooms.grid, rooms.space, uneven, kReach, uneven[0].target), 1u);
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
      return tour.choose(rooms.grid, rooms.space, views, kReach, {});
    };
    const auto best = choose(exact);
    differ += choose(prepared) != best;
    for (std::size_t i = 0; i < views.size(); ++i) prepared.prepare(rooms.grid, rooms.space);
    EXPECT_EQ(choose(prepared), best) << seed;
  }
  EXPECT_GT(differ, 0) << "the estimates are as good";
}

}  // namespace
}  // namespace cca::view_tour_test
