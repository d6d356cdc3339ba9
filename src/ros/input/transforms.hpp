// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "ros/messages/pose_message.hpp"

namespace cca {

/// The name of a frame as tf2 has it: drivers from the days of tf1 begin it with a slash.
std::string frameName(const std::string& frame);

/// The frames that a robot speaks of [REP-105].
struct FrameNames {
  std::string map = "map", odom = "odom", base = "base_link", laser = "laser";
};

/// What tf knows, wherever its messages come from. Frames may be named with or without a slash.
class Transforms {
 public:
  /// Keeps the last two minutes, for who looks poses up as they come: a bag played forty times as
  /// fast as it was recorded may be looked at three seconds late.
  Transforms();
  /// Keeps all of these messages, for who has the whole of them beforehand: as long as the stamps
  /// last, which is what tf2 forgets by, and not the time of recording.
  struct Message {
    tf2_msgs::TFMessage transforms;
    bool is_static;
  };
  explicit Transforms(const std::vector<Message>& messages);

  void add(const tf2_msgs::TFMessage& message, bool is_static);
  /// Forgets all but the static transforms.
  void clear() { buffer_.clear(); }

  bool hasFrame(const std::string& frame) const { return buffer_._frameExists(frameName(frame)); }
  /// @param time  zero: the latest that there is.
  bool has(const std::string& target, const std::string& source, const ros::Time& time) const;
  /// Up to when has() says yes; zero where nothing between the two moves, nothing where tf does not
  /// join them.
  std::optional<ros::Time> latest(const std::string& target, const std::string& source) const;
  /// T_target_source in the plane. @throws std::runtime_error where tf does not know it, or
  /// planarPose() refuses it. Never an identity in place of a missing transform.
  PlanarPose lookup(const std::string& target, const std::string& source,
                    const ros::Time& time) const;
  /// The same in space, however tilted.
  Eigen::Isometry3d lookupInSpace(const std::string& target, const std::string& source,
                                  const ros::Time& time) const;
  /// Why has() says no, in a few words.
  std::string whyNot(const std::string& target, const std::string& source) const;

 private:
  geometry_msgs::Transform find(const std::string& target, const std::string& source,
                                const ros::Time& time) const;

  tf2::BufferCore buffer_;
};

}  // namespace cca
