// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/similarity.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/mapping/cross.hpp"
#include "cca_mrpt/mapping/gates.hpp"

namespace cca {
namespace {

/// z^2 of the distance of b's centroid from a's line, extended that far; in units of the variance
/// of one point.
/// @param centroids  variances of the two centroids, likewise.
double offsetStatistic(const FittedSegment& a, const FittedSegment& b, double centroids) {
  const Eigen::Vector2d between = b.line.centroid - a.line.centroid;
  const Eigen::Vector2d& u = a.line.direction;
  const double along = u.dot(between), across = cross(u, between);
  if (a.line.spread_sum_sq <= 0.0) return 0.0;  // a has no direction at all
  return across * across / (centroids + along * along / a.line.spread_sum_sq);
}

/// z^2 of the angle between the two, likewise.
double orientationStatistic(const FittedSegment& a, const FittedSegment& b) {
  const double spread_a = a.line.spread_sum_sq, spread_b = b.line.spread_sum_sq;
  if (spread_a <= 0.0 || spread_b <= 0.0) return 0.0;
  const Eigen::Vector2d &u = a.line.direction, &v = b.line.direction;
  const double sine = cross(u, v);
  return sine * sine * spread_a * spread_b / (spread_a + spread_b);
}

/// m^2, of what is told by lines.
double residuals(const FittedSegment& a, const FittedSegment& b) {
  return (a.is_line ? a.line.residual_sum_sq : 0.0) + (b.is_line ? b.line.residual_sum_sq : 0.0);
}

/// @param growth  of the residuals, in variances of a point about the common line: over the noise
/// of each line by itself, a long wall that is met at many angles would seem bent.
double fitOfGrowth(const FittedSegment& a, const FittedSegment& b, double growth,
                   double line_price) {
  double saved = -line_price;
  for (const FittedSegment* part : {&a, &b}) saved += part->is_line ? line_price : part->price;
  return saved <= 0.0 ? 0.0 : bell(0.5 * std::max(0.0, growth), saved);
}

}  // namespace

double Memberships::similarity() const {
  return std::min({orientation, offset, gap, fit, overlap});
}

double AlphaCut::similarity(const Memberships& mu) const {
  Memberships asked = mu;
  if (without(Part::kOrientation)) asked.orientation = 1.0;
  if (without(Part::kOffset)) asked.offset = 1.0;
  if (without(Part::kGap)) asked.gap = 1.0;
  if (without(Part::kFit)) asked.fit = 1.0;
  if (without(Part::kOverlap)) asked.overlap = 1.0;
  return asked.similarity();
}

double mostFitMembership(const FittedSegment& a, const FittedSegment& b, double least_residual,
                         double most_variance, double line_price) {
  return fitOfGrowth(a, b, (least_residual - residuals(a, b)) / most_variance, line_price);
}

double fitMembership(const FittedSegment& a, const FittedSegment& b, const JointFit& joint,
                     double line_price) {
  if (joint.points < kFewestPoints) return 0.0;
  return fitOfGrowth(a, b, (joint.residual_sum_sq - residuals(a, b)) / joint.variance, line_price);
}

Memberships memberships(const FittedSegment& a, const FittedSegment& b, const JointFit& joint,
                        double gap_evidence, double line_price) {
  const double line_gate = 2.0 * line_price;  // twice a price in nats is a chi-square
  Memberships mu;
  mu.fit = fitMembership(a, b, joint, line_price);
  const double centroids = 1.0 / a.moments.weight + 1.0 / b.moments.weight;
  const double offset =
      std::max(offsetStatistic(a, b, centroids), offsetStatistic(b, a, centroids)) / joint.variance;
  mu.orientation = bell(orientationStatistic(a, b) / joint.variance, line_gate);
  mu.offset = bell(offset, line_gate);
  mu.gap = bell(gap_evidence, kGapGate);
  mu.overlap = 1.0;  // from one place no two runs are seen side by side
  return mu;
}

}  // namespace cca
