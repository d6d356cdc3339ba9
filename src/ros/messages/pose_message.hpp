// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>

#include <string>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// A spatial pose brought down to the plane.
struct PlanarPose {
  Pose2 pose;                ///< where the frame's origin and x axis lie, seen from above
  bool upside_down = false;  ///< the frame's z axis points down: what turns left turns right
};

/// @throws std::runtime_error for numbers that are not finite, a quaternion that is not of unit
///         length, or a frame tilted more than 15 degrees, whose beams would hit floor or ceiling.
PlanarPose planarPose(const geometry_msgs::Transform& transform);
PlanarPose planarPose(const geometry_msgs::Pose& pose);
/// Of a pose that is known to be in the plane: nothing is checked.
Pose2 flatPose(const geometry_msgs::Pose& pose);

geometry_msgs::Transform transformMessage(const Pose2& pose);
geometry_msgs::Pose poseMessage(const Pose2& pose);
std_msgs::Header headerMessage(const std::string& frame, const ros::Time& stamp);
geometry_msgs::PoseStamped poseMessage(const Pose2& pose, const std::string& frame,
                                       const ros::Time& stamp);
/// T_parent_child.
geometry_msgs::TransformStamped transformMessage(const Pose2& pose, const std::string& parent,
                                                 const std::string& child, const ros::Time& stamp);

/// Places the scan of a laser mounted at T_map_sensor; one mounted upside down sweeps mirrored.
void placeScan(Scan& scan, const PlanarPose& T_map_sensor);

}  // namespace cca
