// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/motion_control.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {
constexpr double kTurningGain = 2.5;  // 1/s; stable at 10 Hz with one period of delay
}

Velocity velocityTowards(const Eigen::Vector2d& target_robot, bool stop_at_target,
                         const RobotParameters& robot) {
  const double distance = target_robot.norm();
  if (distance == 0.0) return {};
  const double bearing = std::atan2(target_robot.y(), target_robot.x());
  const double turn = std::abs(bearing);
  Velocity velocity;
  // The turning rate must be able to fall to zero by the time the bearing does.
  const double braking = std::sqrt(robot.max_angular_acceleration * turn);
  const double rate = std::min({kTurningGain * turn, braking, robot.max_angular_velocity});
  velocity.angular = std::copysign(rate, bearing);
  if (turn >= kTurnOnTheSpot) return velocity;
  velocity.linear = robot.max_linear_velocity * (1.0 - turn / kTurnOnTheSpot);
  // A target close by must not be circled: v / w stays below the arc that leads there.
  if (turn > 0.05) {
    velocity.linear = std::min(velocity.linear, rate * 0.5 * distance / std::sin(turn));
  }
  if (stop_at_target) {
    velocity.linear =
        std::min(velocity.linear, std::sqrt(2.0 * 0.7 * robot.max_linear_acceleration * distance));
  }
  return velocity;
}

}  // namespace cca
