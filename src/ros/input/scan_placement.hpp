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
  Pose2 T_fixed_robot;
  Pose2 T_robot_sensor;               ///< identity where the robot's frame is not asked for
  std::optional<Pose2> T_odom_robot;  ///< where that is asked for and known
  /// Of the laser during the sweep, in the smooth frame where that is known, else in the fixed one:
  /// in the middle, and half of a sweep before and after, where tf knows it.
  SweepMotion motion;
};

/// Whether placeByTf() has what it needs from tf then. @param laser  frame of the scan.
bool hasPlacement(const Transforms& transforms, const PlacementFrames& frames,
                  const std::string& laser, const ros::Time& time);

/// The one way in which scans of bags and of topics are placed: each pose is looked up at once,
/// since one put together from others differs from it in the last bit.
/// @param scan    is given its T_map_sensor in the fixed frame.
/// @param middle  of its sweep.
/// @throws std::runtime_error where tf does not know a pose, or planarPose() refuses it.
ScanPlacement placeByTf(Scan& scan, const Transforms& transforms, const PlacementFrames& frames,
                        const std::string& laser, const ros::Time& middle);

/// Half of a sweep. Of a laser whose driver tells none, half of a usual one.
ros::Duration halfSweep(double sweep_duration);

}  // namespace cca
