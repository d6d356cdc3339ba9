// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/robot.hpp"

#include <algorithm>
#include <cmath>

namespace cca {

namespace {

double towards(double value, double target, double largest_change) {
  return value + std::clamp(target - value, -largest_change, largest_change);
}

}  // namespace

Velocity approach(const Velocity& velocity, const Velocity& command, const RobotParameters& limits,
                  double dt) {
  const double v_max = limits.max_linear_velocity, w_max = limits.max_angular_velocity;
  return {towards(velocity.linear, std::clamp(command.linear, -v_max, v_max),
                  limits.max_linear_acceleration * dt),
          towards(velocity.angular, std::clamp(command.angular, -w_max, w_max),
                  limits.max_angular_acceleration * dt)};
}

Pose2 driveArc(const Pose2& T_map_robot, const Velocity& velocity, double dt) {
  const double way = velocity.linear * dt, turn = velocity.angular * dt, half = 0.5 * turn;
  const double chord = half != 0.0 ? way * std::sin(half) / half : way;
  return T_map_robot * Pose2{chord * std::cos(half), chord * std::sin(half), turn};
}

void Odometry::add(const Velocity& velocity, double dt) {
  const double way = velocity.linear * dt, turn = velocity.angular * dt;
  time_ += dt;
  if (way == 0.0 && turn == 0.0) return;
  const double way_noise = parameters_.distance_noise * std::sqrt(std::abs(way));
  const double turn_noise =
      kRadiansPerDegree * std::hypot(parameters_.turn_noise_deg * std::sqrt(std::abs(turn)),
                                     parameters_.drift_noise_deg * std::sqrt(std::abs(way)));
  const double way_read = way + way_noise * random_.normal();
  const double turn_read = turn + turn_noise * random_.normal();
  way_error_ += way_read - way;
  turn_error_ += turn_read - turn;
  T_odom_robot_ = driveArc(T_odom_robot_, {way_read, turn_read}, 1.0);
}

Velocity Odometry::show(const Velocity& velocity) {
  if (time_ == 0.0) return velocity;
  const Velocity shown{velocity.linear + way_error_ / time_,
                       velocity.angular + turn_error_ / time_};
  way_error_ = turn_error_ = time_ = 0.0;
  return shown;
}

}  // namespace cca
