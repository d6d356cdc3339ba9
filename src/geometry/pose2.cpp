// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/geometry/pose2.hpp"

#include <cmath>

namespace cca {

double wrapAngle(double angle) {
  if (angle > -M_PI && angle <= M_PI) return angle;
  const double wrapped = std::remainder(angle, 2.0 * M_PI);
  return wrapped <= -M_PI ? M_PI : wrapped;
}

Eigen::Vector2d Pose2::heading() const { return {std::cos(theta), std::sin(theta)}; }

Pose2 Pose2::inverse() const {
  const double c = std::cos(theta), s = std::sin(theta);
  return {-c * x - s * y, s * x - c * y, wrapAngle(-theta)};
}

bool isFinite(const Pose2& pose) {
  return pose.position().allFinite() && std::isfinite(pose.theta);
}

bool areNear(const Pose2& a, const Pose2& b, double tolerance) {
  return (a.position() - b.position()).norm() <= tolerance &&
         std::abs(wrapAngle(a.theta - b.theta)) <= tolerance;
}

Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Eigen::Vector2d p = T_a_b * T_b_c.position();
  return {p.x(), p.y(), wrapAngle(T_a_b.theta + T_b_c.theta)};
}

Eigen::Vector3d difference(const Pose2& b, const Pose2& a) {
  return {b.x - a.x, b.y - a.y, wrapAngle(b.theta - a.theta)};
}

Pose2 poseBetween(const Pose2& a, const Pose2& b, double share) {
  const Eigen::Vector3d step = share * difference(b, a);
  return {a.x + step.x(), a.y + step.y(), wrapAngle(a.theta + step.z())};
}

Eigen::Vector2d operator*(const Pose2& T_a_b, const Eigen::Vector2d& p_b) {
  const double c = std::cos(T_a_b.theta), s = std::sin(T_a_b.theta);
  return {T_a_b.x + c * p_b.x() - s * p_b.y(), T_a_b.y + s * p_b.x() + c * p_b.y()};
}

}  // namespace cca
