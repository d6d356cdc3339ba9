// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/commanded_motion.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {
constexpr double kStep = 0.0125;    // s, of the prediction
constexpr double kSameTime = 0.05;  // s: half a control period, which safeVelocity() allows for
}  // namespace

void CommandedMotion::changeMotion(const RobotParameters& robot) {
  const bool obeys_otherwise = robot.latency != robot_.latency ||
                               robot.max_linear_acceleration != robot_.max_linear_acceleration ||
                               robot.max_angular_acceleration != robot_.max_angular_acceleration;
  robot_ = robot_.movingAs(robot);
  if (obeys_otherwise) shown_ = ShownMotion(robot_);
}

void CommandedMotion::observe(const Velocity& measured, double time) {
  shown_.observe(sent_, measured, time);
  measured_ = measured;
  time_ = time;
}

Onset CommandedMotion::after(double latency) const {
  Onset onset{{}, measured_, latency};
  const int steps = static_cast<int>(std::ceil(latency / kStep - 1e-9));
  const double dt = latency / std::max(steps, 1);
  const Velocity speeds_up{robot_.max_linear_acceleration, robot_.max_angular_acceleration};
  const Velocity brakes = shown_.brakes();
  for (int i = 0; i < steps; ++i) {
    const auto command = sent_.at(time_ + (i + 0.5) * dt - latency);
    const Velocity before = onset.velocity;
    if (command) onset.velocity = obey(before, *command, speeds_up, brakes, dt);
    const double way = 0.5 * (before.linear + onset.velocity.linear) * dt;
    const double turn = 0.5 * (before.angular + onset.velocity.angular) * dt;
    onset.T_now_then =
        onset.T_now_then * Pose2{way * std::cos(0.5 * turn), way * std::sin(0.5 * turn), turn};
  }
  return onset;
}

std::vector<Onset> CommandedMotion::otherwise() const {
  std::vector<Onset> onsets;
  for (const double latency : {shown_.earliest(), std::max(robot_.latency, shown_.latest())}) {
    if (std::abs(latency - this->latency()) > kSameTime) onsets.push_back(after(latency));
  }
  return onsets;
}

RobotParameters CommandedMotion::believed() const {
  RobotParameters believed = robot_;
  const Velocity brakes = shown_.brakes();
  believed.max_linear_acceleration = brakes.linear;
  believed.max_angular_acceleration = brakes.angular;
  return believed;
}

}  // namespace cca
