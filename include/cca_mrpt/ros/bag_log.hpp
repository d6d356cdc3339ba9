// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cca {

/// From now on openLog() opens ROS bags too.
///
/// Scans are every sensor_msgs/LaserScan of the topic that has most of them. Poses come from tf:
/// `map` to the robot's base as corrected, `odom` to the base as odometry; where tf does not know
/// them, odometry comes from the nav_msgs/Odometry message before the scan. The base is base_link,
/// else base_footprint, else the laser itself. A pose is that of the middle of the sweep. Where tf
/// knows `map`, scans that it has no pose for are left out, as are those that no laser can have
/// meant, and that is said: the same as in line_mapper, to the bit.
void addBagLogs();

}  // namespace cca
