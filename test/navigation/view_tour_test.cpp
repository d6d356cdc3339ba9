// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/view_tour.hpp"

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

constexpr Cell kRobot{205, 60};  // in the middle of the corridor

/// Squares of half a metre: rooms along both sides of a corridor of 19 m.
struct Rooms {
  KnownScene place;
  Rooms() {
    const KnownWorld rooms{
        {"#########################################", "#......#......#......#......#......#....#",
         "#......#......#......#......#......#....#", "#......#......#......#......#......#....#",
         "###..#####..#####..#####..#####..#####..#", "#.......................................#",
         "#.......................................#", "##..#####..#####..#####..#####..#####..##",
         "#......#......#......#......#......#....#", "#......#......#......#......#......#....#",
         "#......#......#......#......#......#....#", "#########################################"},
        10};
    place.world.seed(rooms.walls(), CellState::kOccupied);
    place.world.seed(rooms.freeCells(), CellState::kFree);
    place.scene.findPaths(place.world.grid().centreOf(kRobot));
  }
  ViewPoint at(Cell cell, double expected) const {
    return {cell, cell, cell, place.scene.distances().distanceTo(cell), expected, expected};
  }
};

TEST(FirstOfTour, IsNoneOfNone) { EXPECT_FALSE(firstOfTour(Rooms{}.place.scene, {}, {})); }

// Two stops in rooms at one end of the corridor, one as much and as near towards the other end.
TEST(FirstOfTour, IsWhereMoreWillBeSeenSoon) {
  const Rooms rooms;
  const ViewPoint alone = rooms.at({125, 60}, 0.5), first = rooms.at({285, 60}, 0.5);
  for (const bool has_second : {false, true}) {
    std::vector<ViewPoint> stops{alone, first};
    if (has_second) stops.push_back(rooms.at({305, 60}, 0.5));
    const auto chosen = firstOfTour(rooms.place.scene, stops, alone.target);
    ASSERT_TRUE(chosen);
    EXPECT_EQ(stops[chosen->first].cell, has_second ? first.cell : alone.cell);
  }
}

TEST(FirstOfTour, IsTheOneThatMostIsExpectedFromAmongTheNear) {
  const Rooms rooms;
  const std::vector<ViewPoint> stops{rooms.at({125, 60}, 0.2), rooms.at({290, 60}, 0.6)};
  EXPECT_EQ(firstOfTour(rooms.place.scene, stops, {})->first, 1u);
}

// Two goals as far off as each other: the present one is kept. Not so where the other one is near.
TEST(FirstOfTour, SeesThePresentGoalWhereAnotherTourIsHardlyCheaper) {
  const Rooms rooms;
  const std::vector<ViewPoint> even{rooms.at({44, 60}, 1.0), rooms.at({366, 60}, 1.0)};
  for (std::size_t present = 0; present < even.size(); ++present)
    EXPECT_EQ(firstOfTour(rooms.place.scene, even, even[present].target)->first, present);
  const std::vector<ViewPoint> uneven{rooms.at({44, 60}, 1.0), rooms.at({300, 60}, 1.0)};
  EXPECT_EQ(firstOfTour(rooms.place.scene, uneven, uneven[0].target)->first, 1u);
}

}  // namespace
}  // namespace cca::view_tour_test
