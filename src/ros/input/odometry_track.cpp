// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_track.hpp"

#include <algorithm>
#include <stdexcept>

#include "ros/messages/pose_message.hpp"

namespace cca {

void OdometryTrack::add(const nav_msgs::Odometry& message) try {
  if (frames_.base.empty()) {
    const std::string odom = frameName(message.header.frame_id);
    const std::string base = frameName(message.child_frame_id);
    frames_ = {odom.empty() ? "odom" : odom, base.empty() ? "base_link" : base};
  }
  const Stamped stamped{message.header.stamp, planarPose(message.pose.pose).pose};
  const auto is_later = [](const ros::Time& stamp, const Stamped& s) { return stamp < s.stamp; };
  const auto after = poses_.empty() || poses_.back().stamp < stamped.stamp
                         ? poses_.end()
                         : std::upper_bound(poses_.begin(), poses_.end(), stamped.stamp, is_later);
  poses_.insert(after, stamped);
} catch (const std::runtime_error&) {
}

std::optional<Pose2> OdometryTrack::at(const ros::Time& time) const {
  const auto is_earlier = [](const Stamped& s, const ros::Time& stamp) { return s.stamp < stamp; };
  const auto b = std::lower_bound(poses_.begin(), poses_.end(), time, is_earlier);
  if (b == poses_.end()) return std::nullopt;
  if (b->stamp == time) return b->pose;
  if (b == poses_.begin()) return std::nullopt;
  const auto a = b - 1;
  const double t = (time - a->stamp).toSec() / (b->stamp - a->stamp).toSec();
  return poseBetween(a->pose, b->pose, t);
}

}  // namespace cca
