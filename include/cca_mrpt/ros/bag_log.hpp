// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cca {

/// From now on openLog() opens ROS bags too.
///
/// Scans are every sensor_msgs/LaserScan of the topic that has most of them. Poses come from tf:
/// `map` to the robot's base as corrected, `odom` to the base as odometry; where tf does not know
/// them, odometry comes from the nav_msgs/Odometry message before the scan. The base is base_link,
/// else base_footprint, else the laser itself. A pose is that of the middle of the sweep. Where tf
/// lacks `map` for a while, the last correction of the odometry stands; scans from before the first
/// one, and those that no laser can have meant, are left out, and said.
void addBagLogs();

}  // namespace cca
