// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "ros/input/transforms.hpp"
#include "sensing/motion_compensation.hpp"

namespace cca {

/// The frames between which a scan is placed.
struct PlacementFrames {
  std::string fixed;                ///< in which the scan is wanted
  std::string base = {};            ///< of the robot; empty: it is the laser itself
  std::string odom = {};            ///< empty: not asked for
  std::optional<PlanarPose> mount;  ///< of the laser on the base, told instead of tf's
  std::string smooth = {};          ///< in which the robot never leaps; empty: the fixed one
};

/// Where tf has a laser and its robot at one time.
struct ScanPlacement {
  PlanarPose T_fixed_sensor;
  Pose2 T_fixed_robot, T_robot_sensor;
  std::optional<Pose2> T_odom_robot;  ///< where that is asked for and known
};

/// Whether placementOf() has what it needs from tf then. @param laser  frame of the scan.
bool hasPlacement(const Transforms& transforms, const PlacementFrames& frames,
                  const std::string& laser, const ros::Time& time);

/// The one way in which scans of bags and of topics are placed: each pose is looked up at once,
/// since one put together from others differs from it in the last bit.
/// @throws std::runtime_error where tf does not know a pose, or planarPose() refuses it.
ScanPlacement placementOf(const Transforms& transforms, const PlacementFrames& frames,
                          const std::string& laser, const ros::Time& time);

/// Half of a sweep. Of a laser whose driver tells none, half of a usual one.
ros::Duration halfSweep(double sweep_duration);

/// How the laser moved during a sweep, by tf in the smooth frame where that is known, else in the
/// fixed one: in the middle, and half of a sweep before and after, where tf knows it.
SweepMotion sweepMotion(const Transforms& transforms, const PlacementFrames& frames,
                        const std::string& laser, const ros::Time& middle,
                        const ros::Duration& half);

}  // namespace cca
