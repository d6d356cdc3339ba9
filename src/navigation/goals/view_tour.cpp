// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/view_tour.hpp"

#include <algorithm>
#include <cmath>
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

constexpr double kStay = 0.5;             // m, by which another tour must cost less than going on
constexpr std::size_t kMostStops = 16;    // of a tour
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

std::optional<std::size_t> ViewTour::choose(const ExplorationGrid& grid, const FreeSpace& space,
                                            const std::vector<ViewPoint>& view_points, double reach,
                                            std::optional<Cell> present, bool only_rests) {
  if (view_points.empty()) return {};
  ++choices_;
  const std::vector<Stop> stops = cover(grid, view_points, reach, present, only_rests);
  const Eigen::MatrixXd distance = distances(grid, space, view_points, stops);
  TourObjective objective;
  objective.hurry = only_rests ? 0.0 : parameters_.hurry;
  double sum = 0.0;
  for (const Stop& stop : stops) sum += stop.gain;
  std::vector<double> worth;
  for (const Stop& stop : stops) {
    objective.weights.push_back(sum > 0.0 ? stop.gain / sum : 0.0);
    worth.push_back(parameters_.worth * stop.promise);
  }

  const Tour best = findTour(distance, objective);
  const std::vector<std::size_t> driven = worthTheWay(distance, worth, best.stops);
  if (driven.empty()) return {};
  for (const std::size_t k : driven) {
    if (!stops[k].sees_present) continue;
    const Tour same = findTour(distance, objective, k);
    if (same.cost < best.cost + kStay) return stops[k].view_point;
  }
  return stops[driven.front()].view_point;
}

std::vector<ViewTour::Stop> ViewTour::cover(const ExplorationGrid& grid,
                                            const std::vector<ViewPoint>& view_points, double reach,
                                            std::optional<Cell> present, bool only_rests) const {
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
    Stop stop{best, 0.0, 0.0, false};
    for (const std::size_t b : sees[best]) {
      if (is_covered[b]) continue;
      is_covered[b] = true;
      stop.gain += view_points[b].gain;
      if (present && view_points[b].target == *present) stop.sees_present = true;
    }
    stop.promise = only_rests ? view_points[best].expected : stop.gain;
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
