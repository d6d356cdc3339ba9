// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/description_length.hpp"

#include <algorithm>

namespace cca {

RunFitter::RunFitter(const std::vector<Eigen::Vector2d>& points, const PointNoise& noise,
                     double vertex_price)
    : prefix_(points),
      noise_(noise),
      vertex_price_(vertex_price),
      line_price_(cca::linePrice(vertex_price)),
      most_variance_(0.0) {
  double farthest_sq = 0.0;
  for (const Eigen::Vector2d& p : points) farthest_sq = std::max(farthest_sq, p.squaredNorm());
  most_variance_ = noise.mostAcross(farthest_sq);
}

double RunFitter::price(int first, int last) const {
  const double alone = kPointPrice * std::max(0, last - first);
  if (last - first < kFewestPoints) return alone;
  const PointMoments moments = prefix_.run(first, last);
  const PrincipalAxis axis = principalAxis(moments);
  const LineNoise noise = noise_.onLine(moments.mean, axis);
  if (!isDrawnOut(moments.weight, axis.spread_sum_sq, noise)) return alone;
  return std::min(alone, line_price_ + 0.5 * axis.residual_sum_sq / noise.across);
}

}  // namespace cca
