// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <string>

#include "cca_mrpt/localisation/localiser.hpp"
#include "ros/input/transforms.hpp"

namespace cca {

/// Publishes where a node believes the robot to be, as REP 105 has it: map -> odom on tf, and the
/// pose with its covariance. Warns where somebody else tells map -> odom, too.
class PosePublisher {
 public:
  /// @param topic  of the pose (geometry_msgs/PoseWithCovarianceStamped).
  PosePublisher(ros::NodeHandle& node, FrameNames frames, const std::string& topic);

  /// After each scan. @param T_odom_robot  at its time.
  void publish(const Estimate& estimate, const Pose2& T_odom_robot, const ros::Time& stamp);

 private:
  void warnOfOthers(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) const;

  FrameNames frames_;
  ros::Publisher transforms_, poses_;
  ros::Subscriber others_;
};

}  // namespace cca
