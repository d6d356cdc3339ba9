// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "ros/input/transforms.hpp"

namespace cca {

/// What nav_msgs/Odometry messages call their frames; empty where there are none, or they say
/// nothing.
struct OdometryFrames {
  std::string odom, base;
};

/// The frames of a robot in a recorded tf, however they are named; empty: there is no such frame.
struct BagFrames {
  std::string map, odom, base;
  /// Whether tf joins the laser with the base.
  bool mount_is_known = false;
};

/// Finds the frames of the robot that carries a laser.
///
/// The base is one of those that the laser hangs on: the one that is called base_link, whatever its
/// prefix; else that of the odometry messages; else base_footprint; else what hangs on a frame
/// called odom, or on the nearest joint that moves, however it is called; else, where the laser
/// hangs on nothing that tells of a robot, the base of the odometry messages, or the one frame that
/// is called base_link or base_footprint. `odom` is above the base: what is called so, else the
/// frame that the base moves in; `map` is what is called so above that.
/// @param laser, base  frames; base empty: to be found.
BagFrames findFrames(const std::vector<Transforms::Message>& messages, const std::string& laser,
                     const OdometryFrames& odometry, const std::string& base);

/// All that tf names, in the order of the alphabet.
std::vector<std::string> frameNames(const std::vector<Transforms::Message>& messages);

}  // namespace cca
