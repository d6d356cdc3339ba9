// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/navigation/goals/view_points.hpp"

namespace cca {

/// How the next goal is chosen, among view points with their way and gain.
enum class Strategy {
  kGreedy,           ///< the largest gain: the paper's Step 0
  kNearestFrontier,  ///< the shortest way [Yamauchi 1997]
  kGainDistance,     ///< gain exp(-0.2 way) [Gonzalez-Banos & Latombe 2002]
  /// The most expected information per metre of way, after [Amigoni & Caglioti 2010].
  /// Deviation: the information is the unknown area in view alone; theirs adds the re-sensing of
  /// known boundaries, which is nothing to a robot whose pose is known.
  kInformation,
  kViewTour,  ///< a frontier that promises much, else the first stop of a tour, see ViewTour
};

/// As options and files name them.
inline constexpr std::pair<const char*, Strategy> kStrategyNames[] = {
    {"view_tour", Strategy::kViewTour},
    {"greedy", Strategy::kGreedy},
    {"nearest_frontier", Strategy::kNearestFrontier},
    {"gain_distance", Strategy::kGainDistance},
    {"information", Strategy::kInformation}};

/// m^2, gain exp(-0.2 way) [Gonzalez-Banos & Latombe 2002].
double discountedGain(const ViewPoint& view_point);

/// @throws std::runtime_error for a name that is none.
Strategy strategyNamed(const std::string& name);

/// The best view point by itself, for all strategies but kViewTour, which looks at all of them.
///
/// @return  its index; the first of equals; empty for no view points.
std::optional<std::size_t> selectGoal(Strategy strategy, const std::vector<ViewPoint>& view_points);

}  // namespace cca
