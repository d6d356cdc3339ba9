// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace cca {

/// A rigid motion of the plane, named after the frames that it joins: p_map = T_map_robot *
/// p_robot.
struct Pose2 {
  double x = 0.0;      ///< m
  double y = 0.0;      ///< m
  double theta = 0.0;  ///< rad, counter-clockwise

  Eigen::Vector2d position() const { return {x, y}; }
  /// Unit vector of the pose's x axis.
  Eigen::Vector2d heading() const;
  Pose2 inverse() const;
};

/// Whether none of its numbers is NaN or infinite.
bool isFinite(const Pose2& pose);

/// Whether two poses differ by no more than a tolerance [m, and rad].
bool areNear(const Pose2& a, const Pose2& b, double tolerance);

/// Composition, T_a_c = T_a_b * T_b_c; theta wrapped to (-pi, pi].
Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c);

/// b - a, number by number: the step (dx, dy, dtheta) [m, m, rad] in the axes of their common frame
/// that takes a to b; dtheta in (-pi, pi].
Eigen::Vector3d difference(const Pose2& b, const Pose2& a);

/// Where a robot is that goes evenly from a to b: straight on, and turning the shorter way round.
/// @param share  of the way, in [0, 1].
Pose2 poseBetween(const Pose2& a, const Pose2& b, double share);

/// A point of frame b in frame a.
Eigen::Vector2d operator*(const Pose2& T_a_b, const Eigen::Vector2d& p_b);

inline constexpr double kRadiansPerDegree = M_PI / 180.0;  // rad/deg, a turn has 360 or 2 pi
inline constexpr double kDegreesPerRadian = 180.0 / M_PI;  // deg/rad, for what people read

/// @param angle  rad, finite.
/// @return       the same angle in (-pi, pi].
double wrapAngle(double angle);

}  // namespace cca
