// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "cca_mrpt/navigation/drive/robot.hpp"

namespace cca {

/// The velocity that leads a differential drive straight to a point: it turns towards it, on the
/// spot where it points more than kTurnOnTheSpot away, and drives the faster the better it points.
///
/// @param target_robot   m, robot frame.
/// @param stop_at_target whether to brake ahead of it with the robot's deceleration.
/// @return  within the robot's velocity limits; acceleration is limited by safeVelocity().
Velocity velocityTowards(const Eigen::Vector2d& target_robot, bool stop_at_target,
                         const RobotParameters& robot);

inline constexpr double kTurnOnTheSpot = 0.7;  ///< rad
/// m/s, as measured: a robot that is slower stands. Odometry is noisy.
inline constexpr double kStands = 0.05;

}  // namespace cca
