// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "baselines/point_runs.hpp"

namespace cca::baselines {

/// A circle through points.
struct FittedCircle {
  Eigen::Vector2d centre;        ///< m
  double radius = 0.0;           ///< m
  double residual_sum_sq = 0.0;  ///< m^2, of the distances from the circle
};

/// The algebraic fit [Kasa 1976]: linear least squares in centre and squared radius.
/// @return  nothing for points on a line, and for fewer than three.
std::optional<FittedCircle> fitCircle(const Points& points, Run run);

/// Whether a circle of a radius up to `largest_radius` [m] fits points better than a line: half of
/// the squared residuals or less, for it has one parameter more.
bool isRound(const Points& points, Run run, double largest_radius);

}  // namespace cca::baselines
