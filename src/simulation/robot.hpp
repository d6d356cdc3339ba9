// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "cca_mrpt/geometry/pose2.hpp"
#include "cca_mrpt/motion/robot.hpp"
#include "cca_mrpt/simulation/parameters.hpp"
#include "simulation/random.hpp"

namespace cca {

/// A velocity that goes towards a command as fast as the accelerations allow.
/// @param dt  s, at least 0.
Velocity approach(const Velocity& velocity, const Velocity& command, const RobotParameters& limits,
                  double dt);

/// Where a differential drive gets to in dt at constant velocity: an exact circular arc.
Pose2 driveArc(const Pose2& T_map_robot, const Velocity& velocity, double dt);

/// A copy of the true motion that errs; the truth never sees it.
class Odometry {
 public:
  Odometry(const Pose2& T_odom_robot, const OdometryParameters& parameters, std::uint64_t seed)
      : T_odom_robot_(T_odom_robot), parameters_(parameters), random_(seed) {}

  /// Takes a true motion of `velocity` over dt seconds.
  void add(const Velocity& velocity, double dt);
  const Pose2& T_odom_robot() const { return T_odom_robot_; }
  /// The velocity that it shows: the true one now, and the mean error since the last call.
  Velocity show(const Velocity& velocity);

 private:
  Pose2 T_odom_robot_;
  OdometryParameters parameters_;
  Random random_;
  double way_error_ = 0.0, turn_error_ = 0.0, time_ = 0.0;  ///< m, rad, s: since show()
};

}  // namespace cca
