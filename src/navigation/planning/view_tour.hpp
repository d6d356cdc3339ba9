// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "navigation/planning/planning_scene.hpp"
#include "navigation/planning/view_points.hpp"

namespace cca {

/// The best open tours from a start through all stops, exactly, one for each stop that it may begin
/// with [Held & Karp 1962].
///
/// A tour costs length + sum_k urgency_k * arrival_k, where arrival_k is the way to stop k along
/// it: without urgency it is the travelling salesman's, with much of it the travelling repairman's,
/// who serves the most urgent stops early.
/// @param distance  (n + 1) x (n + 1), metres; row and column 0 are the start, k + 1 is stop k.
/// @param urgency   of the n stops, >= 0.
/// @return  what each costs, by its first stop. Cost: O(2^n n^2).
std::vector<double> tourCosts(const Eigen::MatrixXd& distance, const std::vector<double>& urgency);

/// Where the order in which few places to look from are driven to begins.
struct TourStart {
  std::size_t first;          ///< the stop to go to
  std::vector<double> costs;  ///< m, of the best tour that begins with each stop
};

/// The best open tour through few places to look from, the more urgent a stop the more is expected
/// to be seen from it. The tour that begins where the present goal is seen from is kept unless
/// another is clearly cheaper.
/// @param stops    twelve at most, with their ways and what is expected of them. Ways between them
///                 are estimated: the mean of the straight line and the way by the robot's place.
/// @param present  target of the present goal, if it still stands.
/// @return         empty where there is no stop. Cost: O(2^n n^2) for n stops.
std::optional<TourStart> firstOfTour(const PlanningScene& scene,
                                     const std::vector<ViewPoint>& stops,
                                     std::optional<Cell> present);

}  // namespace cca
