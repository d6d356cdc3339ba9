// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cca {

/// From now on openLog() opens ROS bags too.
///
/// Scans are those of the topic that is asked for, else of the one with most sensor_msgs/LaserScan
/// or MultiEchoLaserScan (of which the first echo counts). Which frames are the robot's: see
/// findFrames(). Poses come from tf: map to the base as corrected, odom to the base as odometry;
/// where tf does not know the latter, it comes from the nav_msgs/Odometry messages. A pose is that
/// of the middle of the sweep. Where tf knows `map`, or else `odom`, scans that it has no pose for
/// are left out, as are those that no laser can have meant, and that is said: the same as in
/// line_mapper, to the bit. A laser that tf does not join with the robot's base is taken to be in
/// its middle, and that is said, unless its mount is told.
void addBagLogs();

}  // namespace cca
