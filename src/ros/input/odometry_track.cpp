// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_track.hpp"

#include <iterator>
#include <stdexcept>

#include "ros/messages/pose_message.hpp"

namespace cca {

void OdometryTrack::add(const nav_msgs::Odometry& message) try {
  if (frames_.base.empty()) {
    const std::string odom = frameName(message.header.frame_id);
    const std::string base = frameName(message.child_frame_id);
    frames_ = {odom.empty() ? "odom" : odom, base.empty() ? "base_link" : base};
  }
  poses_.emplace(message.header.stamp, planarPose(message.pose.pose).pose);
} catch (const std::runtime_error&) {
}

std::optional<Pose2> OdometryTrack::at(const ros::Time& time) const {
  const auto b = poses_.lower_bound(time);
  if (b == poses_.end()) return std::nullopt;
  if (b->first == time) return b->second;
  if (b == poses_.begin()) return std::nullopt;
  const auto a = std::prev(b);
  const double t = (time - a->first).toSec() / (b->first - a->first).toSec();
  return poseBetween(a->second, b->second, t);
}

}  // namespace cca
