// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/tour.hpp"

#include <algorithm>
#include <limits>

namespace cca {
namespace {

constexpr int kSweeps = 8;
constexpr double kWorthwhile = 1e-9;  // m: less is rounding, and could go round in circles

using Stops = std::vector<std::size_t>;

double costOf(const Eigen::MatrixXd& distance, const TourObjective& objective, const Stops& stops) {
  double length = 0.0, waiting = 0.0;
  Eigen::Index from = 0;
  for (const std::size_t stop : stops) {
    const auto to = static_cast<Eigen::Index>(stop) + 1;
    length += distance(from, to);
    waiting += objective.weights[stop] * length;
    from = to;
  }
  return length + objective.hurry * waiting;
}

/// Cheapest insertion, stop by stop, nowhere before position `fixed`.
Stops inserted(const Eigen::MatrixXd& distance, const TourObjective& objective, Stops stops,
               std::size_t fixed) {
  const auto n = static_cast<std::size_t>(distance.rows()) - 1;
  for (std::size_t stop = 0; stop < n; ++stop) {
    if (std::find(stops.begin(), stops.end(), stop) != stops.end()) continue;
    Stops best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t at = fixed; at <= stops.size(); ++at) {
      Stops longer = stops;
      longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(at), stop);
      const double cost = costOf(distance, objective, longer);
      if (cost >= least) continue;
      least = cost;
      best = std::move(longer);
    }
    stops = std::move(best);
  }
  return stops;
}

/// One sweep over all moves; each that helps is made at once. @return whether one helped.
bool improve(const Eigen::MatrixXd& distance, const TourObjective& objective, Tour& tour,
             std::size_t fixed) {
  const std::size_t n = tour.stops.size();
  bool helped = false;
  Stops trial;
  const auto tryIt = [&] {
    const double cost = costOf(distance, objective, trial);
    if (cost >= tour.cost - kWorthwhile) return;
    tour = {trial, cost};
    helped = true;
  };
  const auto at = [](Stops& stops, std::size_t i) {
    return stops.begin() + static_cast<std::ptrdiff_t>(i);
  };
  for (std::size_t i = fixed; i < n; ++i) {
    for (std::size_t j = i + 2; j <= n; ++j) {
      trial = tour.stops;
      std::reverse(at(trial, i), at(trial, j));
      tryIt();
    }
    for (std::size_t length = 1; length <= 3 && i + length <= n; ++length) {
      for (std::size_t to = fixed; to + length <= n; ++to) {
        if (to == i) continue;
        trial = tour.stops;
        if (to < i) {
          std::rotate(at(trial, to), at(trial, i), at(trial, i + length));
        } else {
          std::rotate(at(trial, i), at(trial, i + length), at(trial, to + length));
        }
        tryIt();
      }
    }
  }
  return helped;
}

}  // namespace

Tour findTour(const Eigen::MatrixXd& distance, const TourObjective& objective,
              std::optional<std::size_t> first) {
  const std::size_t fixed = first ? 1 : 0;
  Tour tour;
  tour.stops = inserted(distance, objective, first ? Stops{*first} : Stops{}, fixed);
  tour.cost = costOf(distance, objective, tour.stops);
  for (int sweep = 0; sweep < kSweeps && improve(distance, objective, tour, fixed); ++sweep) {
  }
  return tour;
}

std::vector<std::size_t> worthTheWay(const Eigen::MatrixXd& distance,
                                     const std::vector<double>& worth,
                                     std::vector<std::size_t> stops) {
  const auto way = [&](std::size_t position) {  // to the stop there, from the one before
    const auto row = [&](std::size_t at) { return static_cast<Eigen::Index>(stops[at]) + 1; };
    return distance(position > 0 ? row(position - 1) : 0, row(position));
  };
  // m, by which the tour without a stop falls short of the tour with it.
  const auto value = [&](std::size_t position) {
    const std::size_t stop = stops[position];
    double detour = way(position);
    if (position + 1 < stops.size()) {
      detour += way(position + 1);
      stops.erase(stops.begin() + static_cast<std::ptrdiff_t>(position));
      detour -= way(position);
      stops.insert(stops.begin() + static_cast<std::ptrdiff_t>(position), stop);
    }
    return worth[stop] - detour;
  };
  while (!stops.empty()) {
    std::size_t worst = 0;
    for (std::size_t i = 1; i < stops.size(); ++i) {
      if (value(i) < value(worst)) worst = i;
    }
    if (value(worst) >= 0.0) break;
    stops.erase(stops.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  double sum = 0.0, most = 0.0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    sum += worth[stops[i]] - way(i);
    if (sum <= most) continue;
    most = sum;
    kept = i + 1;
  }
  stops.resize(kept);
  return stops;
}

}  // namespace cca
