// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// Where the laser was at a time, in a frame in which the robot moves smoothly: its odometry's.
struct SensorReading {
  Pose2 T_odom_sensor;
  double time;  ///< s
};

/// What is known of the laser's motion during a sweep.
struct SweepMotion {
  /// In the middle of the sweep, or at the stamp where that is not known; nothing where there is no
  /// odometry or no time.
  std::optional<SensorReading> middle = {};
  /// Before and after that, best at the sweep's ends; nothing where nobody tells.
  std::optional<SensorReading> before = {}, after = {};
};

/// The motion of a sensor during a sweep, of constant acceleration: from the first beam in time to
/// the middle and from there to the last, both in its frame in the middle and by its mean velocity.
struct SweepHalves {
  Pose2 before, after;
};

/// A sweep as it was undone.
struct SweptScan {
  SweepHalves motion;
  double sense = 1.0;  ///< 1: beams followed one another counter-clockwise; -1: clockwise
};

}  // namespace cca
