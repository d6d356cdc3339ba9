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

constexpr double kMustBeVisited = std::numeric_limits<double>::infinity();

double costOf(const Eigen::MatrixXd& distance, const TourObjective& objective,
              const std::vector<std::size_t>& stops) {
  double length = 0.0, waiting = 0.0, left_out = 0.0;
  Eigen::Index from = 0;
  for (const std::size_t stop : stops) {
    length += distance(from, static_cast<Eigen::Index>(stop) + 1);
    waiting += objective.weights[stop] * length;
    from = static_cast<Eigen::Index>(stop) + 1;
  }
  for (std::size_t k = 0; k < objective.worth.size(); ++k) {
    if (std::count(stops.begin(), stops.end(), k) == 0) left_out += objective.worth[k];
  }
  return length + objective.hurry * waiting + left_out;
}

/// Of all orders of all stops, and of the beginnings of these.
double leastCostOfAll(const Eigen::MatrixXd& distance, const TourObjective& objective) {
  std::vector<std::size_t> stops(static_cast<std::size_t>(distance.rows()) - 1);
  std::iota(stops.begin(), stops.end(), 0u);
  double least = std::numeric_limits<double>::infinity();
  do {
    for (std::size_t kept = 1; kept <= stops.size(); ++kept) {
      const auto end = stops.begin() + static_cast<std::ptrdiff_t>(kept);
      least = std::min(least, costOf(distance, objective, {stops.begin(), end}));
    }
  } while (std::next_permutation(stops.begin(), stops.end()));
  return least;
}

Tour bestOf(const Eigen::MatrixXd& distance, const TourObjective& objective) {
  const auto tours = findTours(distance, objective);
  return *std::min_element(tours.begin(), tours.end(),
                           [](const Tour& a, const Tour& b) { return a.cost < b.cost; });
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
    for (int i = 0; i < stops; ++i) {
      objective.weights.push_back(place(random) / 20.0 / stops);
      objective.worth.push_back(kMustBeVisited);
    }
  }
};

TEST(Tours, AreTheBestOfAllOrders) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const double hurry : {0.0, 1.0, 10.0}) {
      const RandomPlaces p(seed, 7, hurry);
      const Tour tour = bestOf(p.distance, p.objective);
      EXPECT_EQ(tour.stops.size(), 7u);
      EXPECT_NEAR(tour.cost, costOf(p.distance, p.objective, tour.stops), 1e-9);
      EXPECT_NEAR(tour.cost, leastCostOfAll(p.distance, p.objective), 1e-9);
    }
  }
}

TEST(Tours, LeaveOutWhatMakesThemTheBestOfAllThatLeaveSomethingOut) {
  int left_out = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomPlaces p(seed, 6, 0.0);
    for (std::size_t k = 0; k < 6; ++k) p.objective.worth[k] = 1.0 + static_cast<double>(k) * 2.0;
    const Tour tour = bestOf(p.distance, p.objective);
    left_out += 6 - static_cast<int>(tour.stops.size());
    EXPECT_NEAR(tour.cost, costOf(p.distance, p.objective, tour.stops), 1e-9);
    EXPECT_NEAR(tour.cost, leastCostOfAll(p.distance, p.objective), 1e-9);
  }
  EXPECT_GT(left_out, 20);
  EXPECT_LT(left_out, 100);
}

TEST(Tours, BeginWithEachStopAndVisitEachOnce) {
  const RandomPlaces p(5, 12, 10.0);
  const std::vector<Tour> tours = findTours(p.distance, p.objective);
  ASSERT_EQ(tours.size(), 12u);
  for (std::size_t first = 0; first < 12; ++first) {
    std::vector<std::size_t> stops = tours[first].stops;
    EXPECT_EQ(stops.front(), first);
    EXPECT_NEAR(tours[first].cost, costOf(p.distance, p.objective, stops), 1e-9);
    std::sort(stops.begin(), stops.end());
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(stops[i], i);
  }
}

TEST(Tours, ServeTheHeavyStopFirstOnlyWhereTheyHurry) {
  // On a line: a light stop 1 m to the left, a heavy one 2 m to the right.
  Eigen::MatrixXd distance(3, 3);
  distance << 0, 1, 2, 1, 0, 3, 2, 3, 0;
  TourObjective objective;
  objective.weights = {0.1, 0.9};
  objective.worth = {kMustBeVisited, kMustBeVisited};
  EXPECT_EQ(bestOf(distance, objective).stops.front(), 0u);
  objective.hurry = 10.0;
  EXPECT_EQ(bestOf(distance, objective).stops.front(), 1u);
}

TEST(Tours, OfNoStopsAreNone) { EXPECT_TRUE(findTours(Eigen::MatrixXd::Zero(1, 1), {}).empty()); }

/// Of places on a line, the start at 0.
std::vector<std::size_t> worthTheWay(const std::vector<double>& places,
                                     const std::vector<double>& worth) {
  const auto n = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd distance = Eigen::MatrixXd::Zero(n + 1, n + 1);
  const auto at = [&](Eigen::Index i) {
    return i > 0 ? places[static_cast<std::size_t>(i) - 1] : 0.0;
  };
  for (Eigen::Index i = 0; i <= n; ++i) {
    for (Eigen::Index j = 0; j <= n; ++j) distance(i, j) = std::abs(at(i) - at(j));
  }
  TourObjective objective;
  objective.weights.assign(places.size(), 0.0);
  objective.worth = worth;
  const Tour best = bestOf(distance, objective);
  const double of_all = std::accumulate(worth.begin(), worth.end(), 0.0);
  return best.cost < of_all ? best.stops : std::vector<std::size_t>{};
}

TEST(Tours, LeaveOutAStopWhoseDetourIsLongerThanItsWorth) {
  using Stops = std::vector<std::size_t>;
  EXPECT_EQ(worthTheWay({-2.0, 3.0, 5.0}, {5.0, 9.0, 9.0}), (Stops{0, 1, 2}));
  EXPECT_EQ(worthTheWay({-2.0, 3.0, 5.0}, {3.0, 9.0, 9.0}), (Stops{1, 2}));
  EXPECT_EQ(worthTheWay({-2.0, 3.0, 5.0}, {5.0, 0.0, 9.0}), (Stops{0, 1, 2})) << "on the way";
}

// Each of the two far ones is a short way from the other, but not from where the robot is.
TEST(Tours, EndWhereAllThatComesIsNotWorthTheWayThere) {
  using Stops = std::vector<std::size_t>;
  EXPECT_EQ(worthTheWay({1.0, 20.0, 21.0}, {2.0, 5.0, 5.0}), (Stops{0}));
  EXPECT_EQ(worthTheWay({1.0, 20.0, 21.0}, {2.0, 15.0, 15.0}), (Stops{0, 1, 2}));
  EXPECT_TRUE(worthTheWay({1.0, 20.0, 21.0}, {0.5, 5.0, 5.0}).empty());
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
