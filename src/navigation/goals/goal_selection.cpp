// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/goal_selection.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cca {
namespace {

constexpr double kPerMetre = 0.2;     // lambda of [Gonzalez-Banos & Latombe 2002]
constexpr double kShortestWay = 0.2;  // m: ways are measured in blocks of this size

double score(Strategy strategy, const ViewPoint& view_point) {
  switch (strategy) {
    case Strategy::kGreedy:
      return view_point.gain;
    case Strategy::kGainDistance:
      return discountedGain(view_point);
    case Strategy::kInformation:
      return view_point.gain / std::max(view_point.distance, kShortestWay);
    case Strategy::kNearestFrontier:
    case Strategy::kViewTour:
      break;
  }
  return -view_point.distance;
}

}  // namespace

double discountedGain(const ViewPoint& view_point) {
  return view_point.gain * std::exp(-kPerMetre * view_point.distance);
}

Strategy strategyNamed(const std::string& name) {
  std::string names;
  for (const auto& [known, strategy] : kStrategyNames) {
    if (name == known) return strategy;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw std::runtime_error("strategy '" + name + "' is none of " + names);
}

std::optional<std::size_t> selectGoal(Strategy strategy,
                                      const std::vector<ViewPoint>& view_points) {
  std::optional<std::size_t> best;
  double best_score = 0.0;
  for (std::size_t i = 0; i < view_points.size(); ++i) {
    const double s = score(strategy, view_points[i]);
    if (best && s <= best_score) continue;
    best = i;
    best_score = s;
  }
  return best;
}

}  // namespace cca
