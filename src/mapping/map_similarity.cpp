// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/map_similarity.hpp"

#include <algorithm>

#include "cca_mrpt/mapping/cross.hpp"
#include "cca_mrpt/mapping/gates.hpp"

namespace cca {
namespace {

/// Squared distance of b's centroid from a's line, which is extended that far, over its variance.
double offsetEvidence(const LineSegment& a, const Eigen::Vector2d& u, const LineSegment& b) {
  const Eigen::Vector2d between = b.moments.mean - a.moments.mean;
  const double along = u.dot(between), across = cross(u, between);
  const double variance =
      a.covariance(0, 0) + along * along * a.covariance(1, 1) + b.covariance(0, 0);
  return variance > 0.0 ? across * across / variance : 0.0;
}

}  // namespace

Memberships mapMemberships(const LineSegment& a, const LineSegment& b, double gap,
                           bool same_facing) {
  const FittedLine line_a = fitLine(a.moments), line_b = fitLine(b.moments);
  Memberships mu;
  const double sine = cross(line_a.direction, line_b.direction);
  const double angle_variance = a.covariance(1, 1) + b.covariance(1, 1);
  mu.orientation = angle_variance > 0.0 ? bell(sine * sine / angle_variance, kChiSquareGate1) : 1.0;
  mu.offset =
      bell(std::max(offsetEvidence(a, line_a.direction, b), offsetEvidence(b, line_b.direction, a)),
           kChiSquareGate1);
  mu.gap = bell(gap * gap, 1.0);

  PointMoments joint = a.moments;
  joint.add(b.moments);
  const double growth =
      fitLine(joint).residual_sum_sq - line_a.residual_sum_sq - line_b.residual_sum_sq;
  const double variance =
      0.5 * (a.covariance(0, 0) * a.moments.weight + b.covariance(0, 0) * b.moments.weight);
  mu.fit = variance > 0.0 ? bell(std::max(0.0, growth) / variance, kChiSquareGate2) : 1.0;
  mu.overlap = same_facing ? 1.0 : 0.0;
  return mu;
}

}  // namespace cca
