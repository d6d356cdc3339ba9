// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planning/view_tour.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cca {
namespace {

// Weight of the mean arrival, by what is expected, against the length of the tour. With 3 or 30 the
// robot drives 2 to 5 % farther to 90 % in furnished buildings, and elsewhere as far.
constexpr double kHurry = 10.0;
constexpr double kStay = 0.5;  // m, by which another tour must cost less than going on

/// (n + 1) x (n + 1) m, as tourCosts() takes them.
Eigen::MatrixXd waysBetween(const std::vector<ViewPoint>& stops, double resolution) {
  const auto n = static_cast<Eigen::Index>(stops.size());
  Eigen::MatrixXd ways = Eigen::MatrixXd::Zero(n + 1, n + 1);
  for (Eigen::Index i = 1; i <= n; ++i) {
    const ViewPoint& stop = stops[static_cast<std::size_t>(i) - 1];
    ways(0, i) = ways(i, 0) = stop.distance;
    for (Eigen::Index j = 1; j < i; ++j) {
      const ViewPoint& other = stops[static_cast<std::size_t>(j) - 1];
      const double line = distanceBetween(stop.cell, other.cell) * resolution;
      ways(i, j) = ways(j, i) = 0.5 * (line + stop.distance + other.distance);
    }
  }
  return ways;
}

}  // namespace

std::vector<double> tourCosts(const Eigen::MatrixXd& distance, const std::vector<double>& urgency) {
  const std::size_t n = urgency.size();
  const auto bit = [](std::size_t stop) { return std::size_t{1} << stop; };
  const auto row = [](std::size_t stop) { return static_cast<Eigen::Index>(stop) + 1; };
  const std::size_t all = bit(n) - 1;
  // The cost of a metre driven now, by the stops that were visited; and what is still to come at
  // the least, by these and the last of them.
  std::vector<double> pace(all + 1, 1.0), to_come(n << n);
  const auto through = [&](std::size_t visited, Eigen::Index from, std::size_t next) {
    return pace[visited] * distance(from, row(next)) + to_come[(visited | bit(next)) * n + next];
  };
  for (std::size_t visited = 0; visited < all; ++visited) {
    for (std::size_t k = 0; k < n; ++k) pace[visited] += visited & bit(k) ? 0.0 : urgency[k];
  }
  for (std::size_t visited = all; visited-- > 1;) {
    for (std::size_t last = 0; last < n; ++last) {
      if (!(visited & bit(last))) continue;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < n; ++k) {
        if (!(visited & bit(k))) least = std::min(least, through(visited, row(last), k));
      }
      to_come[visited * n + last] = least;
    }
  }
  std::vector<double> costs;
  for (std::size_t first = 0; first < n; ++first) costs.push_back(through(0, 0, first));
  return costs;
}

std::optional<TourStart> firstOfTour(const PlanningScene& scene,
                                     const std::vector<ViewPoint>& stops,
                                     std::optional<Cell> present) {
  if (stops.empty()) return {};
  double sum = 0.0;
  for (const ViewPoint& stop : stops) sum += stop.expected;
  std::vector<double> urgency;
  for (const ViewPoint& stop : stops) {
    urgency.push_back(sum > 0.0 ? kHurry * stop.expected / sum : 0.0);
  }
  auto costs = tourCosts(waysBetween(stops, scene.grid().resolution()), urgency);
  auto best =
      static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  const double kept_below = costs[best] + kStay;
  for (std::size_t k = 0; present && k < stops.size(); ++k) {
    const bool sees_present =
        isInView(scene.grid(), stops[k].cell, *present, scene.world().laserRange());
    if (sees_present && costs[k] < kept_below) best = k;
  }
  return TourStart{best, std::move(costs)};
}

}  // namespace cca
