// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/pose_message.hpp"

#include <cmath>
#include <stdexcept>

namespace cca {
namespace {

constexpr double kLargestTilt = 15.0 * M_PI / 180.0;

geometry_msgs::Quaternion yawMessage(double theta) {
  geometry_msgs::Quaternion q;
  q.z = std::sin(0.5 * theta);
  q.w = std::cos(0.5 * theta);
  return q;
}

}  // namespace

PlanarPose planarPose(const geometry_msgs::Transform& transform) {
  const auto& q = transform.rotation;
  const auto& t = transform.translation;
  const double norm_sq = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!std::isfinite(t.x) || !std::isfinite(t.y) || !(std::abs(norm_sq - 1.0) < 1e-2)) {
    throw std::runtime_error("transform: not a rigid motion");
  }
  // First column and last element of the rotation matrix.
  const double xx = norm_sq - 2.0 * (q.y * q.y + q.z * q.z), xy = 2.0 * (q.x * q.y + q.z * q.w);
  const double up = norm_sq - 2.0 * (q.x * q.x + q.y * q.y);
  if (std::abs(up) < std::cos(kLargestTilt) * norm_sq) {
    throw std::runtime_error("transform: tilted more than 15 degrees from the plane");
  }
  return {{t.x, t.y, std::atan2(xy, xx)}, up < 0.0};
}

PlanarPose planarPose(const geometry_msgs::Pose& pose) {
  geometry_msgs::Transform transform;
  transform.translation.x = pose.position.x;
  transform.translation.y = pose.position.y;
  transform.rotation = pose.orientation;
  return planarPose(transform);
}

Pose2 flatPose(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  return {pose.position.x, pose.position.y, 2.0 * std::atan2(q.z, q.w)};
}

geometry_msgs::Transform transformMessage(const Pose2& pose) {
  geometry_msgs::Transform message;
  message.translation.x = pose.x;
  message.translation.y = pose.y;
  message.rotation = yawMessage(pose.theta);
  return message;
}

geometry_msgs::Pose poseMessage(const Pose2& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  message.orientation = yawMessage(pose.theta);
  return message;
}

std_msgs::Header headerMessage(const std::string& frame, const ros::Time& stamp) {
  std_msgs::Header message;
  message.frame_id = frame;
  message.stamp = stamp;
  return message;
}

geometry_msgs::PoseStamped poseMessage(const Pose2& pose, const std::string& frame,
                                       const ros::Time& stamp) {
  geometry_msgs::PoseStamped message;
  message.header = headerMessage(frame, stamp);
  message.pose = poseMessage(pose);
  return message;
}

geometry_msgs::TransformStamped transformMessage(const Pose2& pose, const std::string& parent,
                                                 const std::string& child, const ros::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header = headerMessage(parent, stamp);
  message.child_frame_id = child;
  message.transform = transformMessage(pose);
  return message;
}

void placeScan(Scan& scan, const PlanarPose& T_map_sensor) {
  scan.T_map_sensor = T_map_sensor.pose;
  if (!T_map_sensor.upside_down) return;
  scan.angle_min = -scan.angle_min;
  scan.angle_increment = -scan.angle_increment;
}

}  // namespace cca
