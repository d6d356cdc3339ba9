// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cca {

/// Velocity of a differential drive in its own frame.
struct Velocity {
  double linear = 0.0;   ///< m/s, forwards
  double angular = 0.0;  ///< rad/s, counter-clockwise
};

/// What the planner must know of a round differential-drive robot.
struct RobotParameters {
  double radius = 0.25;
  double safety_margin = 0.04;
  double max_linear_velocity = 0.7;
  double max_angular_velocity = 1.5;
  double max_linear_acceleration = 1.0;
  double max_angular_acceleration = 4.0;
  /// A simulated robot obeys at once, one out there hardly ever does: the nodes of ROS begin there
  /// with kLatencyOutThere.
  double latency = 0.0;
  static constexpr double kLatencyOutThere = 0.15;  ///< s, a control period and some buffers

  /// Of the safety margin, never given up: narrow passages are worth a try. Paths ask for as much
  /// as Tangent Bug does; where they differ, passages in between are tried in vain, for minutes.
  static constexpr double kLeastMargin = 0.4;
  /// m, from the robot's centre to what it must not come nearer to.
  double leastClearance() const { return radius + kLeastMargin * safety_margin; }

  /// These, with the speeds, accelerations and latency of another.
  RobotParameters movingAs(const RobotParameters& other) const {
    RobotParameters robot = other;
    robot.radius = radius;
    robot.safety_margin = safety_margin;
    return robot;
  }
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(RobotParameters& p, Field&& field) {
  field("radius", p.radius, 0.01, 5.0, "m", "radius of the smallest circle around the robot");
  field("safety_margin", p.safety_margin, 0.0, 2.0, "m", "clearance kept beyond the radius");
  field("max_linear_velocity", p.max_linear_velocity, 0.01, 10.0, "m/s", "forward speed limit");
  field("max_angular_velocity", p.max_angular_velocity, 0.01, 20.0, "rad/s", "turning speed limit");
  field("max_linear_acceleration", p.max_linear_acceleration, 0.01, 50.0, "m/s^2",
        "limit of speeding up and braking");
  field("max_angular_acceleration", p.max_angular_acceleration, 0.01, 100.0, "rad/s^2",
        "limit of the turning rate's change");
  field("latency", p.latency, 0.0, 0.5, "s",
        "from a command to where the base acts on it; the simulated robot has it, and knows it");
}

}  // namespace cca
