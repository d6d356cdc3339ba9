// SPDX-License-Identifier: BSD-3-Clause
#include "pose_publisher.hpp"

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

/// map -> odom changes slowly: it holds for so much longer than the scan that it was found with, so
/// that others can place what comes before the next scan. The same is amcl's default.
const ros::Duration kHolds(0.1);

}  // namespace

PosePublisher::PosePublisher(ros::NodeHandle& node, FrameNames frames, const std::string& topic)
    : frames_(std::move(frames)),
      transforms_(node.advertise<tf2_msgs::TFMessage>("/tf", 100)),
      poses_(node.advertise<geometry_msgs::PoseWithCovarianceStamped>(topic, 10)),
      others_(node.subscribe("/tf", 200, &PosePublisher::warnOfOthers, this)) {}

void PosePublisher::publish(const Estimate& estimate, const Pose2& T_odom_robot,
                            const ros::Time& stamp) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {transformMessage(estimate.T_map_robot * T_odom_robot.inverse(),
                                            frames_.map, frames_.odom, stamp + kHolds)};
  transforms_.publish(transforms);
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header = headerMessage(frames_.map, stamp);
  pose.pose.pose = poseMessage(estimate.T_map_robot);
  constexpr int kRows[] = {0, 1, 5};  // x, y, yaw of a pose in space
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      pose.pose.covariance[static_cast<std::size_t>(6 * kRows[i] + kRows[j])] =
          estimate.covariance(i, j);
    }
  }
  poses_.publish(pose);
}

void PosePublisher::warnOfOthers(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) const {
  if (event.getPublisherName() == ros::this_node::getName()) return;
  for (const auto& transform : event.getMessage()->transforms) {
    if (frameName(transform.child_frame_id) != frameName(frames_.odom)) continue;
    ROS_WARN_THROTTLE(5.0, "%s tells where '%s' is, too: the robot will be seen in two places",
                      event.getPublisherName().c_str(), frames_.odom.c_str());
  }
}

}  // namespace cca
