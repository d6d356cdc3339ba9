// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/ros/scan_placement.hpp"

namespace cca {

bool hasPlacement(const Transforms& transforms, const PlacementFrames& frames,
                  const std::string& laser, const ros::Time& time) {
  const bool needs_laser = frames.base.empty() || !frames.mount;
  return (!needs_laser || transforms.has(frames.fixed, laser, time)) &&
         (frames.base.empty() || transforms.has(frames.fixed, frames.base, time));
}

ScanPlacement placementOf(const Transforms& transforms, const PlacementFrames& frames,
                          const std::string& laser, const ros::Time& time) {
  ScanPlacement placement;
  const std::string& robot = frames.base.empty() ? laser : frames.base;
  if (frames.base.empty()) {
    placement.T_fixed_sensor = transforms.lookup(frames.fixed, laser, time);
    placement.T_fixed_robot = placement.T_fixed_sensor.pose;
  } else if (frames.mount) {
    const PlanarPose T_fixed_robot = transforms.lookup(frames.fixed, robot, time);
    placement.T_fixed_robot = T_fixed_robot.pose;
    placement.T_robot_sensor = frames.mount->pose;
    placement.T_fixed_sensor = {T_fixed_robot.pose * frames.mount->pose,
                                T_fixed_robot.upside_down != frames.mount->upside_down};
  } else {
    placement.T_fixed_sensor = transforms.lookup(frames.fixed, laser, time);
    placement.T_fixed_robot = transforms.lookup(frames.fixed, robot, time).pose;
    placement.T_robot_sensor = transforms.lookup(robot, laser, time).pose;
  }
  if (!frames.odom.empty() && transforms.has(frames.odom, robot, time)) {
    placement.T_odom_robot = transforms.lookup(frames.odom, robot, time).pose;
  }
  return placement;
}

}  // namespace cca
