// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <string>

#include "cca_mrpt/ros/pose_message.hpp"

namespace cca {

/// tf, in the node's own thread and with a call after each message that brought some. (The listener
/// of tf2_ros gives neither; a scan that waits for its pose is then served the moment that it
/// comes.)
class TransformFeed {
 public:
  TransformFeed(ros::NodeHandle& node, std::function<void()> on_change);

  bool knows(const std::string& target, const std::string& source, const ros::Time& time,
             std::string* why_not) const;
  /// T_target_source in the plane. @throws std::runtime_error where tf does not know it, or
  /// planarPose() refuses it. Never an identity in place of a missing transform.
  PlanarPose lookup(const std::string& target, const std::string& source,
                    const ros::Time& time) const;
  /// Forgets all but the static transforms: the clock has been set back.
  void clear() { buffer_.clear(); }

 private:
  void take(const tf2_msgs::TFMessage& message, bool is_static);

  tf2::BufferCore buffer_;
  std::function<void()> on_change_;
  ros::Subscriber moving_, fixed_;
};

}  // namespace cca
