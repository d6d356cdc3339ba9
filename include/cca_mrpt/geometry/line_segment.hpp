// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/point_sums.hpp"

namespace cca {

/// A straight piece of wall with the statistics of the points that it stands on.
///
/// The covariance is that of (lateral offset [m], orientation [rad]) of the supporting line, taken
/// at the centroid of the points, where the two are uncorrelated for independent noise
/// [Pfister et al. 2003; Arras & Siegwart 1997].
struct LineSegment {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< m
  PointMoments moments;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

  double length() const { return (end - start).norm(); }
  /// Unit vector from start to end; (1, 0) where the two coincide.
  Eigen::Vector2d direction() const;
};

/// The line through the mean along the largest principal axis of the scatter (total least squares).
struct FittedLine {
  Eigen::Vector2d centroid;      ///< m
  Eigen::Vector2d direction;     ///< unit
  double residual_sum_sq = 0.0;  ///< m^2, weighted sum of squared distances from the line
  double spread_sum_sq = 0.0;    ///< m^2, the same along the line
};

/// The eigenvalues of a scatter, and the double angle of its larger axis: no half angle is taken.
struct PrincipalAxis {
  double residual_sum_sq = 0.0;  ///< m^2, smaller eigenvalue, >= 0
  double spread_sum_sq = 0.0;    ///< m^2, larger eigenvalue
  double cos_2 = 1.0;            ///< of twice the angle from the x axis
  double sin_2 = 0.0;
};

/// @param moments  any; where the scatter has no preferred axis, that is the x axis.
inline PrincipalAxis principalAxis(const PointMoments& moments) {
  const double half_difference = 0.5 * (moments.scatter(0, 0) - moments.scatter(1, 1));
  const double mid = 0.5 * (moments.scatter(0, 0) + moments.scatter(1, 1));
  const double sxy = moments.scatter(0, 1);
  const double swing = std::sqrt(half_difference * half_difference + sxy * sxy);
  PrincipalAxis axis;
  axis.residual_sum_sq = std::max(0.0, mid - swing);
  axis.spread_sum_sq = std::max(0.0, mid + swing);
  if (swing <= 0.0) return axis;
  axis.cos_2 = half_difference / swing;
  axis.sin_2 = sxy / swing;
  return axis;
}

/// m^2, a lower bound of the residual_sum_sq, without roots: determinant over trace.
inline double leastResidual(const PointMoments& moments) {
  const double xx = moments.scatter(0, 0), xy = moments.scatter(0, 1), yy = moments.scatter(1, 1);
  return xx + yy > 0.0 ? (xx * yy - xy * xy) / (xx + yy) : 0.0;
}

/// Total least squares in closed form.
/// @param moments  any; where the scatter has no preferred axis the direction is (1, 0).
inline FittedLine fitLine(const PointMoments& moments) {
  const PrincipalAxis axis = principalAxis(moments);
  FittedLine line;
  line.centroid = moments.mean;
  line.residual_sum_sq = axis.residual_sum_sq;
  line.spread_sum_sq = axis.spread_sum_sq;
  // The half angle without trigonometry, by whichever of sine and cosine is the larger.
  const double larger = std::sqrt(0.5 * (1.0 + std::abs(axis.cos_2)));
  const double smaller = 0.5 * std::abs(axis.sin_2) / larger;
  const bool level = axis.cos_2 >= 0.0;
  line.direction = {level ? larger : smaller, std::copysign(level ? smaller : larger, axis.sin_2)};
  return line;
}

/// Where two lines meet [m]; nothing where their directions are within 3 degrees, for then noise
/// decides where.
std::optional<Eigen::Vector2d> intersection(const FittedLine& a, const FittedLine& b);

/// Moments of any run of a sequence of points in O(1), by running sums about the common mean.
class PrefixMoments {
 public:
  /// @param weights  of the points; 1 each where none are given.
  explicit PrefixMoments(const std::vector<Eigen::Vector2d>& points,
                         const std::vector<double>& weights = {});

  // Sum by sum: taken away as a whole they go through memory, and K-means takes a tenth longer.
  /// Moments of points first <= i < last; empty where last <= first.
  PointMoments run(int first, int last) const {
    PointMoments moments;
    if (last <= first) return moments;
    const PointSums &a = at(first), &b = at(last);
    const double w = b.w - a.w, x = (b.x - a.x) / w, y = (b.y - a.y) / w;
    const double xy = b.xy - a.xy - w * x * y;
    moments.weight = w;
    moments.mean = {origin_.x() + x, origin_.y() + y};
    moments.scatter << b.xx - a.xx - w * x * x, xy, xy, b.yy - a.yy - w * y * y;
    return moments;
  }
  /// m^2, a lower bound of the residual_sum_sq of points first <= i < last, at least one.
  double leastResidual(int first, int last) const {
    const PointSums &a = at(first), &b = at(last);
    const double w = b.w - a.w, x = b.x - a.x, y = b.y - a.y;
    // The smaller eigenvalue is at least determinant / trace; here of w times the scatter.
    const double xx = w * (b.xx - a.xx) - x * x, yy = w * (b.yy - a.yy) - y * y;
    const double xy = w * (b.xy - a.xy) - x * y, trace = xx + yy;
    return trace > 0.0 ? (xx * yy - xy * xy) / (w * trace) : 0.0;
  }

 private:
  const PointSums& at(int i) const { return sums_[static_cast<std::size_t>(i)]; }
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<PointSums> sums_;  ///< about origin_
};

}  // namespace cca
