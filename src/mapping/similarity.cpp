// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/similarity.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

/// Twice a price in nats is a chi-square: where mu_1 and mu_2 stand at one half.
constexpr double kLineGate = 2.0 * kLinePrice;
/// 99.9 % quantile of chi-square, one degree of freedom.
constexpr double kSideBySideGate = 10.83;

double bell(double evidence, double gate) { return gate / (gate + evidence); }  // 0 for infinity

/// z^2 of the distance of b's centroid from a's line, extended that far.
double offsetStatistic(const FittedSegment& a, const FittedSegment& b, double variance) {
  const Eigen::Vector2d between = b.line.centroid - a.line.centroid;
  const Eigen::Vector2d& u = a.line.direction;
  const double along = u.dot(between), across = u.x() * between.y() - u.y() * between.x();
  // In units of the variance of one point; spread 0 means that a has no direction at all.
  if (a.line.spread_sum_sq <= 0.0) return 0.0;
  const double scale =
      1.0 / a.moments.weight + along * along / a.line.spread_sum_sq + 1.0 / b.moments.weight;
  return across * across / (variance * scale);
}

double orientationStatistic(const FittedSegment& a, const FittedSegment& b, double variance) {
  if (a.line.spread_sum_sq <= 0.0 || b.line.spread_sum_sq <= 0.0) return 0.0;
  const Eigen::Vector2d &u = a.line.direction, &v = b.line.direction;
  const double sine = u.x() * v.y() - u.y() * v.x();
  return sine * sine / (variance * (1.0 / a.line.spread_sum_sq + 1.0 / b.line.spread_sum_sq));
}

}  // namespace

double Memberships::similarity() const {
  return std::min({orientation, offset, gap, fit, overlap});
}

double mostFitMembership(const FittedSegment& a, const FittedSegment& b,
                         double least_half_chi_square) {
  double evidence = least_half_chi_square, saved = -kLinePrice;
  for (const FittedSegment* part : {&a, &b}) {
    saved += part->is_line ? kLinePrice : part->price;
    if (part->is_line) evidence -= 0.5 * part->chi_square;
  }
  return saved <= 0.0 ? 0.0 : bell(std::max(0.0, evidence), saved);
}

double fitMembership(const FittedSegment& a, const FittedSegment& b, const JointFit& joint) {
  if (joint.points < kFewestPoints) return 0.0;
  return mostFitMembership(a, b, 0.5 * joint.chi_square);
}

Memberships memberships(const FittedSegment& a, const FittedSegment& b, const JointFit& joint,
                        double gap_evidence, double overlap) {
  Memberships mu;
  mu.fit = fitMembership(a, b, joint);
  const double offset =
      std::max(offsetStatistic(a, b, joint.variance), offsetStatistic(b, a, joint.variance));
  mu.orientation = bell(orientationStatistic(a, b, joint.variance), kLineGate);
  mu.offset = bell(offset, kLineGate);
  mu.gap = bell(gap_evidence, kGapGate);
  mu.overlap = bell(overlap * offset, kSideBySideGate);
  return mu;
}

}  // namespace cca
