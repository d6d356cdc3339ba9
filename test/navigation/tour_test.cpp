// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace cca {
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

}  // namespace
}  // namespace cca
