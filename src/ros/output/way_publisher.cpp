// SPDX-License-Identifier: BSD-3-Clause
#include "way_publisher.hpp"

#include <cmath>

#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

constexpr double kStep = 0.05, kTurn = 0.2;  // m, rad between poses

}  // namespace

WayPublisher::WayPublisher(ros::NodeHandle& node, const std::string& frame)
    : publisher_(node.advertise<nav_msgs::Path>("trajectory", 1, true)) {
  way_.header.frame_id = frame;
}

void WayPublisher::add(const Pose2& T_map_robot, const ros::Time& stamp) {
  if (!way_.poses.empty()) {
    const Pose2 last = flatPose(way_.poses.back().pose);
    const double way = std::hypot(T_map_robot.x - last.x, T_map_robot.y - last.y);
    if (way < kStep && std::abs(wrapAngle(T_map_robot.theta - last.theta)) < kTurn) return;
  }
  way_.poses.push_back(poseMessage(T_map_robot, way_.header.frame_id, stamp));
}

void WayPublisher::replace(const std::vector<double>& times,
                           const std::vector<Pose2>& T_map_robot) {
  way_.poses.clear();
  for (std::size_t k = 0; k < times.size(); ++k) add(T_map_robot[k], ros::Time(times[k]));
}

void WayPublisher::publish(const ros::Time& stamp) {
  way_.header.stamp = stamp;
  publisher_.publish(way_);
}

}  // namespace cca
