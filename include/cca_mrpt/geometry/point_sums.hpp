// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace cca {

/// Sufficient statistics of weighted points for a total-least-squares line: merges are exact, O(1).
struct PointMoments {
  double weight = 0.0;                                ///< sum of the weights; the number of points
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();     ///< m
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();  ///< m^2, sum of w (p - mean)(p - mean)^T

  void add(const Eigen::Vector2d& point, double point_weight = 1.0) {
    add(PointMoments{point_weight, point, Eigen::Matrix2d::Zero()});
  }
  void add(const PointMoments& other) {
    const double sum = weight + other.weight;
    if (sum <= 0.0) return;
    const Eigen::Vector2d offset = other.mean - mean;
    scatter += other.scatter + (weight * other.weight / sum) * offset * offset.transpose();
    mean += (other.weight / sum) * offset;
    weight = sum;
  }
};

/// y = offset + slope * x.
struct LateralFit {
  double offset = 0.0;  ///< m
  double slope = 0.0;   ///< rad, for it is small
  double at(double x) const { return offset + slope * x; }
};

/// Sums over weighted points, about an origin that lies near them: they can be joined and parted
/// again.
struct PointSums {
  double w = 0.0;                       ///< the weights; the number of points
  double x = 0.0, y = 0.0;              ///< m
  double xx = 0.0, xy = 0.0, yy = 0.0;  ///< m^2

  void addPoint(double px, double py, double weight = 1.0) {
    const double wx = weight * px, wy = weight * py;
    add({weight, wx, wy, wx * px, wx * py, wy * py});
  }
  void add(const PointSums& other) {
    w += other.w;
    x += other.x;
    y += other.y;
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
  }
  void remove(const PointSums& other) {
    w -= other.w;
    x -= other.x;
    y -= other.y;
    xx -= other.xx;
    xy -= other.xy;
    yy -= other.yy;
  }
  void scale(double factor) {
    for (double* sum : {&w, &x, &y, &xx, &xy, &yy}) *sum *= factor;
  }
  /// The same about their mean, w > 0.
  PointMoments moments() const {
    const double x_mean = x / w, y_mean = y / w, s_xy = xy - w * x_mean * y_mean;
    PointMoments m{w, {x_mean, y_mean}, {}};
    m.scatter << xx - w * x_mean * x_mean, s_xy, s_xy, yy - w * y_mean * y_mean;
    return m;
  }
  /// The same of the points turned and then shifted: (x, y) comes to shift + (cosine x - sine y,
  /// sine x + cosine y).
  PointSums moved(const Eigen::Vector2d& shift, double cosine, double sine) const;

  /// Least squares of y; zero without points, level where all lie at one x.
  LateralFit fit() const;
  /// m^2, weighted sum of the squared residuals of fit().
  double residual() const;
};

}  // namespace cca
