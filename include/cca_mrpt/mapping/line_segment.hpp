// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cca {

/// Sufficient statistics of weighted points for a total-least-squares line: merges are exact, O(1).
struct PointMoments {
  double weight = 0.0;                                ///< sum of the weights; the number of points
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();     ///< m
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();  ///< m^2, sum of w (p - mean)(p - mean)^T

  void add(const Eigen::Vector2d& point, double point_weight = 1.0);
  void add(const PointMoments& other);
};

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

/// Total least squares in closed form.
/// @param moments  any; where the scatter has no preferred axis the direction is (1, 0).
FittedLine fitLine(const PointMoments& moments);

/// Moments of any run of a sequence of points in O(1), by running sums about the common mean.
class PrefixMoments {
 public:
  explicit PrefixMoments(const std::vector<Eigen::Vector2d>& points);

  /// Moments of points first <= i < last; empty where last <= first.
  PointMoments run(int first, int last) const;

 private:
  struct Sums {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  };
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<Sums> sums_;
};

}  // namespace cca
