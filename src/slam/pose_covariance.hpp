// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace cca {

/// A covariance of (x, y, theta) [m^2, m rad, rad^2] in axes turned by `angle` [rad].
inline Eigen::Matrix3d rotatedCovariance(const Eigen::Matrix3d& covariance, double angle) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R * covariance * R.transpose();
}

/// The covariance of a pose at the end of `arm` [m]: the error of the heading moves that end.
inline Eigen::Matrix3d leveredCovariance(const Eigen::Matrix3d& covariance,
                                         const Eigen::Vector2d& arm) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J(0, 2) = -arm.y();
  J(1, 2) = arm.x();
  return J * covariance * J.transpose();
}

}  // namespace cca
