// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace cca {

/// What a tour costs: a mean of two things one would like to be short.
///
/// cost = length + hurry * sum_k weight_k * arrival_k, where arrival_k is the way to stop k along
/// the tour. hurry = 0: the open travelling salesman; hurry -> inf: the travelling repairman, who
/// serves the heaviest stops early.
struct TourObjective {
  double hurry = 0.0;
  std::vector<double> weights;  ///< of the stops; they need not add up to one
};

struct Tour {
  std::vector<std::size_t> stops;  ///< each once, in order
  double cost = 0.0;
};

/// An open tour from a start through all stops: cheapest insertion, then moving of chains (Or-opt)
/// and reversing (2-opt) until neither helps.
///
/// @param distance  (n + 1) x (n + 1), metres, finite; row and column 0 are the start, k + 1 is
///                  stop k.
/// @param first     a stop that must come first.
/// @return          every stop once; empty for n = 0.
/// Cost: O(n^3) a sweep, a few sweeps.
Tour findTour(const Eigen::MatrixXd& distance, const TourObjective& objective,
              std::optional<std::size_t> first = {});

/// What of a tour is worth its way: a stop whose detour is longer than its worth is left out, and
/// so are the last stops from where on the way costs more than all of them are worth.
///
/// @param distance  as for findTour(). @param worth  of each stop, m. @param stops  a tour.
/// @return          its stops that are left, in order. Cost: O(n^2).
std::vector<std::size_t> worthTheWay(const Eigen::MatrixXd& distance,
                                     const std::vector<double>& worth,
                                     std::vector<std::size_t> stops);

}  // namespace cca
