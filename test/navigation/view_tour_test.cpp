// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/view_tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "known_world.hpp"

namespace cca::view_tour_test {
namespace {

double costOf(const Eigen::MatrixXd& distance, const TourObjective& objective,
              const std::vector<std::size_t>& stops) {
  double length = 0.0, waiting = 0.0;
  Eigen::Index from = 0;
  for (const std::size_t stop : stops) {
    length += distance(from, static_cast<Eigen::Index>(stop) + 1);
    waiting += objective.weights[stop] * length;
    from = static_cast<Eigen::Index>(stop) + 1;
  }
  return length + objective.hurry * waiting;
}

double leastCostOfAll(const Eigen::MatrixXd& distance, const TourObjective& objective) {
  std::vector<std::size_t> stops(static_cast<std::size_t>(distance.rows()) - 1);
  std::iota(stops.begin(), stops.end(), 0u);
  double least = costOf(distance, objective, stops);
  while (std::next_permutation(stops.begin(), stops.end()))
    least = std::min(least, costOf(distance, objective, stops));
  return least;
}

struct RandomPlaces {
  Eigen::MatrixXd distance;
  TourObjective objective;
  RandomPlaces(unsigned seed, int stops, double hurry) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.0, 20.0);
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i <= stops; ++i) points.emplace_back(place(random), place(random));
    distance.resize(stops + 1, stops + 1);
    for (int i = 0; i <= stops; ++i) {
      for (int j = 0; j <= stops; ++j)
        distance(i, j) =
            (points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(j)]).norm();
    }
    objective.hurry = hurry;
    for (int i = 0; i < stops; ++i) objective.weights.push_back(place(random) / 20.0 / stops);
  }
};

TEST(Tour, IsWithinFivePercentOfTheBestOfAllOrders) {
  double sum = 0.0, best_sum = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const double hurry : {0.0, 1.0, 10.0}) {
      const RandomPlaces p(seed, 7, hurry);
      const Tour tour = findTour(p.distance, p.objective);
      const double best = leastCostOfAll(p.distance, p.objective);
      EXPECT_NEAR(tour.cost, costOf(p.distance, p.objective, tour.stops), 1e-9);
      EXPECT_GE(tour.cost, best - 1e-9);
      sum += tour.cost;
      best_sum += best;
    }
  }
  EXPECT_LT(sum, 1.05 * best_sum);
}

TEST(Tour, VisitsEachStopOnce) {
  const RandomPlaces p(5, 16, 10.0);
  Tour tour = findTour(p.distance, p.objective, 11);
  EXPECT_EQ(tour.stops.front(), 11u);
  std::sort(tour.stops.begin(), tour.stops.end());
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(tour.stops[i], i);
}

TEST(Tour, ServesTheHeavyStopFirstOnlyWhereItHurries) {
  // On a line: a light stop 1 m to the left, a heavy one 2 m to the right.
  Eigen::MatrixXd distance(3, 3);
  distance << 0, 1, 2, 1, 0, 3, 2, 3, 0;
  TourObjective objective;
  objective.weights = {0.1, 0.9};
  EXPECT_EQ(findTour(distance, objective).stops.front(), 0u);
  objective.hurry = 10.0;
  EXPECT_EQ(findTour(distance, objective).stops.front(), 1u);
}

TEST(Tour, OfNoStopsIsEmpty) {
  EXPECT_TRUE(findTour(Eigen::MatrixXd::Zero(1, 1), {}).stops.empty());
}

/// Places on a line, the start at 0.
Eigen::MatrixXd onALine(const std::vector<double>& places) {
  const auto n = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd distance = Eigen::MatrixXd::Zero(n + 1, n + 1);
  const auto at = [&](Eigen::Index i) {
    return i > 0 ? places[static_cast<std::size_t>(i) - 1] : 0.0;
  };
  for (Eigen::Index i = 0; i <= n; ++i) {
    for (Eigen::Index j = 0; j <= n; ++j) distance(i, j) = std::abs(at(i) - at(j));
  }
  return distance;
}

TEST(WorthTheWay, LeavesAStopOutWhoseDetourIsLongerThanItsWorth) {
  const Eigen::MatrixXd distance = onALine({-2.0, 3.0, 5.0});
  EXPECT_EQ(worthTheWay(distance, {5.0, 9.0, 9.0}, {0, 1, 2}), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(worthTheWay(distance, {3.0, 9.0, 9.0}, {0, 1, 2}), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(worthTheWay(distance, {5.0, 0.0, 9.0}, {0, 1, 2}), (std::vector<std::size_t>{0, 1, 2}))
      << "on the way";
}

// Each of the two far ones is a short way from the other, but not from where the robot is.
TEST(WorthTheWay, EndsWhereAllThatComesIsNotWorthTheWayThere) {
  const Eigen::MatrixXd distance = onALine({1.0, 20.0, 21.0});
  EXPECT_EQ(worthTheWay(distance, {2.0, 5.0, 5.0}, {0, 1, 2}), (std::vector<std::size_t>{0}));
  EXPECT_EQ(worthTheWay(distance, {2.0, 15.0, 15.0}, {0, 1, 2}),
            (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(worthTheWay(distance, {0.5, 5.0, 5.0}, {0, 1, 2}).empty());
  EXPECT_TRUE(worthTheWay(distance, {}, {}).empty());
}

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
}  // namespace cca::view_tour_test
