// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/view_tour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cca {
namespace {

constexpr double kStay = 0.5;             // m, by which another tour must cost less than going on
constexpr std::size_t kMostStops = 12;    // of a tour: some 1 ms
constexpr double kHorizon = 40.0;         // m, beyond which ways between stops are only estimated
constexpr std::uint32_t kFieldLife = 30;  // choices: known space grows, so ways get shorter
constexpr std::size_t kMostFields = 32;

/// Per view point, the view points whose targets it sees; its own always.
std::vector<std::vector<std::size_t>> visibility(const ExplorationGrid& grid,
                                                 const std::vector<ViewPoint>& view_points,
                                                 double reach) {
  std::vector<std::vector<std::size_t>> sees(view_points.size());
  for (std::size_t a = 0; a < view_points.size(); ++a) {
    for (std::size_t b = 0; b < view_points.size(); ++b) {
      const Cell from = view_points[a].cell, to = view_points[b].target;
      if (a == b ||
          (distanceBetween(from, to) * grid.resolution() < reach && isInView(grid, from, to)))
        sees[a].push_back(b);
    }
  }
  return sees;
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

std::optional<std::size_t> ViewTour::choose(const ExplorationGrid& grid, const FreeSpace& space,
                                            const std::vector<ViewPoint>& view_points, double reach,
                                            std::optional<Cell> present) {
  if (view_points.empty()) return {};
  ++choices_;
  const std::vector<Stop> stops = cover(grid, view_points, reach, present);
  double sum = 0.0;
  for (const Stop& stop : stops) sum += stop.gain;
  std::vector<double> urgency;
  for (const Stop& stop : stops) {
    urgency.push_back(sum > 0.0 ? parameters_.hurry * stop.gain / sum : 0.0);
  }
  const auto costs = tourCosts(distances(grid, space, view_points, stops), urgency);
  auto best =
      static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  const double kept_below = costs[best] + kStay;
  for (std::size_t k = 0; k < stops.size(); ++k) {
    if (stops[k].sees_present && costs[k] < kept_below) best = k;
  }
  return stops[best].view_point;
}

std::vector<ViewTour::Stop> ViewTour::cover(const ExplorationGrid& grid,
                                            const std::vector<ViewPoint>& view_points, double reach,
                                            std::optional<Cell> present) const {
  const auto sees = visibility(grid, view_points, reach);
  std::vector<bool> is_covered(view_points.size(), false);
  std::vector<Stop> stops;
  while (stops.size() < kMostStops) {
    std::size_t best = 0;
    std::ptrdiff_t most = 0;
    for (std::size_t a = 0; a < view_points.size(); ++a) {
      const auto count = std::count_if(sees[a].begin(), sees[a].end(),
                                       [&](std::size_t b) { return !is_covered[b]; });
      const bool is_nearer = view_points[a].distance < view_points[best].distance;
      if (count < most || count == 0 || (count == most && !is_nearer)) continue;
      most = count;
      best = a;
    }
    if (most == 0) break;
    Stop stop{best, 0.0, false};
    for (const std::size_t b : sees[best]) {
      if (is_covered[b]) continue;
      is_covered[b] = true;
      stop.gain += view_points[b].gain;
      if (present && view_points[b].target == *present) stop.sees_present = true;
    }
    stops.push_back(stop);
  }
  return stops;
}

Eigen::MatrixXd ViewTour::distances(const ExplorationGrid& grid, const FreeSpace& space,
                                    const std::vector<ViewPoint>& view_points,
                                    const std::vector<Stop>& stops) {
  const auto n = static_cast<Eigen::Index>(stops.size());
  Eigen::MatrixXd distance = Eigen::MatrixXd::Zero(n + 1, n + 1);
  const auto view = [&](Eigen::Index i) -> const ViewPoint& {
    return view_points[stops[static_cast<std::size_t>(i) - 1].view_point];
  };
  int budget = parameters_.fields_per_choice;
  last_stops_.clear();
  estimated_.clear();
  for (Eigen::Index i = 1; i <= n; ++i) {
    distance(0, i) = distance(i, 0) = view(i).distance;
    DistanceField* field = i > 1 ? fieldAt(grid, space, view(i).cell, budget) : nullptr;
    if (i > 1 && !field) estimated_.push_back(last_stops_.size());
    last_stops_.push_back(view(i).cell);
    for (Eigen::Index j = 1; j < i; ++j) {
      double way = field ? field->reach(space, view(j).cell) : DistanceField::kUnreached;
      // Beyond the horizon or the budget: somewhere between the straight line and the way by the
      // robot's place.
      if (way == DistanceField::kUnreached) {
        way = 0.5 * (view(i).distance + view(j).distance +
                     distanceBetween(view(i).cell, view(j).cell) * grid.resolution());
      }
      distance(i, j) = distance(j, i) = way;
    }
  }
  return distance;
}

void ViewTour::prepare(const ExplorationGrid& grid, const FreeSpace& space) {
  if (estimated_.empty()) return;
  const std::size_t stop = estimated_.back();
  estimated_.pop_back();
  int budget = 1;
  DistanceField* field = fieldAt(grid, space, last_stops_[stop], budget);
  for (std::size_t before = 0; before < stop; ++before) field->reach(space, last_stops_[before]);
}

DistanceField* ViewTour::fieldAt(const ExplorationGrid& grid, const FreeSpace& space, Cell cell,
                                 int& budget) {
  constexpr int kSameSite = 2;  // blocks
  const Cell block = FreeSpace::blockOf(cell);
  auto entry = std::find_if(fields_.begin(), fields_.end(), [&](const CachedField& cached) {
    return squareDistance(cached.block, block) <= kSameSite;
  });
  if (entry != fields_.end() && choices_ - entry->made < kFieldLife) {
    entry->used = choices_;
    return &entry->field;
  }
  if (budget-- <= 0) return nullptr;
  if (entry == fields_.end() && fields_.size() < kMostFields) {
    entry = fields_.insert(entry, CachedField{});
  } else if (entry == fields_.end()) {
    entry = std::min_element(fields_.begin(), fields_.end(),
                             [](const auto& a, const auto& b) { return a.used < b.used; });
  }
  entry->block = block;
  entry->made = entry->used = choices_;
  entry->field.begin(space, grid.resolution(), cell, kHorizon);
  return &entry->field;
}

}  // namespace cca
