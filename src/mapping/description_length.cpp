// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/description_length.hpp"

#include <algorithm>

namespace cca {

FittedSegment::FittedSegment(const PointMoments& points, const FittedLine& fitted,
                             double point_variance)
    : moments(points),
      line(fitted),
      variance(point_variance),
      chi_square(fitted.residual_sum_sq / point_variance) {
  const double told = kLinePrice + 0.5 * chi_square, alone = kPointPrice * points.weight;
  is_line = points.weight >= kFewestPoints && told < alone && fitted.spread_sum_sq > point_variance;
  price = is_line ? told : alone;
}

FittedSegment RunFitter::fit(const PointMoments& moments) const {
  const FittedLine line = fitLine(moments);
  return {moments, line, noise_.lateralVariance(line.centroid, line.direction)};
}

FittedRun RunFitter::fit(int first, int last) const {
  FittedRun run;
  static_cast<FittedSegment&>(run) = fit(prefix_.run(first, last));
  run.first = first;
  run.last = last;
  return run;
}

double RunFitter::price(int first, int last) const {
  const double alone = kPointPrice * std::max(0, last - first);
  if (last - first < kFewestPoints) return alone;
  const PointMoments moments = prefix_.run(first, last);
  const PrincipalAxis axis = principalAxis(moments);
  const double variance = noise_.lateralVariance(moments.mean, axis);
  const double told = kLinePrice + 0.5 * axis.residual_sum_sq / variance;
  return axis.spread_sum_sq > variance ? std::min(told, alone) : alone;
}

}  // namespace cca
