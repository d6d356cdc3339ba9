// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/similarity.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

/// 99.9 % quantiles of chi-square with one and two degrees of freedom.
constexpr double kChiSquare1 = 10.83, kChiSquare2 = 13.82;
/// Segments that share half of the shorter one lie side by side.
constexpr double kOverlapGate = 0.5 * 0.5;
/// One point may fail to return, or one ray slip by, without breaking a wall.
constexpr double kGapGate = 1.5 * 1.5;

double bell(double statistic, double gate) {
  return 1.0 / (1.0 + statistic / gate);
}

/// z^2 of the distance of b's centroid from a's line, extended that far.
double offsetStatistic(const LineSegment& a, const Eigen::Vector2d& direction_a,
                       const LineSegment& b) {
  const Eigen::Vector2d between = b.moments.mean - a.moments.mean;
  const double along = between.dot(direction_a);
  const double across = direction_a.x() * between.y() - direction_a.y() * between.x();
  const double variance =
      a.covariance(0, 0) + along * along * a.covariance(1, 1) + b.covariance(0, 0);
  return across * across / variance;
}

double overlapShare(const LineSegment& a, const LineSegment& b, const Eigen::Vector2d& along) {
  const double a0 = a.start.dot(along), a1 = a.end.dot(along);
  const double b0 = b.start.dot(along), b1 = b.end.dot(along);
  const double shared =
      std::min(std::max(a0, a1), std::max(b0, b1)) - std::max(std::min(a0, a1), std::min(b0, b1));
  const double shorter = std::min(std::abs(a1 - a0), std::abs(b1 - b0));
  if (shared <= 0.0) return 0.0;
  return shorter > 0.0 ? shared / shorter : 1.0;
}

}  // namespace

double Memberships::similarity() const {
  return std::min({orientation, offset, gap, fit, overlap});
}

Memberships memberships(const LineSegment& a, const LineSegment& b, double gap_evidence) {
  const FittedLine line_a = fitLine(a.moments), line_b = fitLine(b.moments);
  const Eigen::Vector2d &u = line_a.direction, &v = line_b.direction;
  Memberships mu;
  const double sine = u.x() * v.y() - u.y() * v.x();
  mu.orientation = bell(sine * sine / (a.covariance(1, 1) + b.covariance(1, 1)), kChiSquare1);
  mu.offset = bell(std::max(offsetStatistic(a, u, b), offsetStatistic(b, v, a)), kChiSquare1);
  mu.gap = bell(gap_evidence * gap_evidence, kGapGate);

  PointMoments joint = a.moments;
  joint.add(b.moments);
  const FittedLine line = fitLine(joint);
  const double variance =
      0.5 * (a.covariance(0, 0) * a.moments.weight + b.covariance(0, 0) * b.moments.weight);
  const double growth =
      std::max(0.0, line.residual_sum_sq - line_a.residual_sum_sq - line_b.residual_sum_sq);
  mu.fit = bell(growth / variance, kChiSquare2);
  const double share = overlapShare(a, b, line.direction);
  mu.overlap = bell(share * share, kOverlapGate);
  return mu;
}

}  // namespace cca
