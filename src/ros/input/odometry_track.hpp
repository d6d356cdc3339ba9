// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>

#include <map>
#include <optional>

#include "cca_mrpt/geometry/pose2.hpp"
#include "ros/bags/bag_frames.hpp"

namespace cca {

/// T_odom_robot by nav_msgs/Odometry, for bags whose tf does not tell it.
class OdometryTrack {
 public:
  /// What planarPose() refuses is passed over.
  void add(const nav_msgs::Odometry& message);
  /// Of the first message; what it leaves open is called as ever. Empty without messages.
  const OdometryFrames& frames() const { return frames_; }
  /// Between two messages, the pose between theirs; nothing before the first and after the last.
  std::optional<Pose2> at(const ros::Time& time) const;

 private:
  OdometryFrames frames_;
  std::multimap<ros::Time, Pose2> poses_;  ///< by their stamps
};

}  // namespace cca
