// SPDX-License-Identifier: BSD-3-Clause
#include "outer_localisation.hpp"

#include <cmath>

namespace cca {

OuterLocalisation::OuterLocalisation(ros::NodeHandle& node, const CcaParameters& mapping)
    : mapping_(mapping),
      corrections_(mapping),
      path_(node.subscribe("corrected_path", 1, &OuterLocalisation::correct, this)) {}

bool OuterLocalisation::take(const PlacedScan& placed) {
  if (!placed.T_odom_robot) return false;
  if (placed.topic != 0) {
    corrections_.addBeside(placed.scan, placed.topic);
    return false;
  }
  const bool is_corrected = corrections_.add(placed.scan, placed.T_fixed_robot,
                                             *placed.T_odom_robot, placed.stamp.toSec());
  if (is_corrected) {
    ROS_INFO("the localisation was corrected: the past is placed anew%s",
             corrections_.isTold() ? " by corrected_path" : "");
  }
  return is_corrected;
}

std::vector<StampedPose> OuterLocalisation::way() const {
  std::vector<StampedPose> way;
  for (const auto& pose : corrections_.way()) way.push_back({pose.time, pose.T_map_robot});
  return way;
}

void OuterLocalisation::correct(const nav_msgs::Path& path) {
  std::vector<OuterCorrections::TimedPose> poses;
  for (const auto& stamped : path.poses) {
    const auto& p = stamped.pose.position;
    const auto& q = stamped.pose.orientation;
    poses.push_back({stamped.header.stamp.toSec(), {p.x, p.y, 2.0 * std::atan2(q.z, q.w)}});
  }
  corrections_.correct(std::move(poses));
}

}  // namespace cca
