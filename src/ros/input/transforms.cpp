// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input/transforms.hpp"

#include <tf2/exceptions.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace cca {
namespace {

const ros::Duration kTransformsKept(120.0);

/// By how much the stamps of moving transforms differ, and a second for rounding. tf2 adds it to a
/// stamp, which must not leave the range of ros::Time; nor may it leave that of ros::Duration.
ros::Duration span(const std::vector<Transforms::Message>& messages) {
  ros::Time first = ros::TIME_MAX, last = ros::TIME_MIN;
  for (const auto& message : messages) {
    if (message.is_static) continue;
    for (const auto& transform : message.transforms.transforms) {
      first = std::min(first, transform.header.stamp);
      last = std::max(last, transform.header.stamp);
    }
  }
  if (last < first) return ros::Duration(1.0);
  constexpr double kLongest = std::numeric_limits<std::int32_t>::max();
  const double seconds = last.toSec() - first.toSec() + 1.0;
  return ros::Duration(std::min({seconds, kLongest - 1.0, ros::TIME_MAX.toSec() - last.toSec()}));
}

}  // namespace

std::string frameName(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

Transforms::Transforms() : buffer_(kTransformsKept) {}

Transforms::Transforms(const std::vector<Message>& messages) : buffer_(span(messages)) {
  for (const auto& message : messages) add(message.transforms, message.is_static);
}

void Transforms::add(const tf2_msgs::TFMessage& message, bool is_static) {
  for (auto transform : message.transforms) {
    transform.header.frame_id = frameName(transform.header.frame_id);
    transform.child_frame_id = frameName(transform.child_frame_id);
    // tf2 itself refuses what is not finite, and says so on the console.
    buffer_.setTransform(transform, "tf", is_static);
  }
}

bool Transforms::has(const std::string& target, const std::string& source,
                     const ros::Time& time) const {
  return buffer_.canTransform(frameName(target), frameName(source), time);
}

std::optional<ros::Time> Transforms::latest(const std::string& target,
                                            const std::string& source) const {
  if (!has(target, source, {})) return std::nullopt;
  return buffer_.lookupTransform(frameName(target), frameName(source), {}).header.stamp;
}

geometry_msgs::Transform Transforms::find(const std::string& target, const std::string& source,
                                          const ros::Time& time) const try {
  return buffer_.lookupTransform(frameName(target), frameName(source), time).transform;
} catch (const tf2::TransformException& error) {
  throw std::runtime_error(error.what());
}

PlanarPose Transforms::lookup(const std::string& target, const std::string& source,
                              const ros::Time& time) const {
  return planarPose(find(target, source, time));
}

Eigen::Isometry3d Transforms::lookupInSpace(const std::string& target, const std::string& source,
                                            const ros::Time& time) const {
  const geometry_msgs::Transform m = find(target, source, time);
  const auto& q = m.rotation;
  return Eigen::Translation3d(m.translation.x, m.translation.y, m.translation.z) *
         Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

std::string Transforms::whyNot(const std::string& target, const std::string& source) const {
  for (const std::string& frame : {target, source}) {
    if (!hasFrame(frame)) return "tf has no frame '" + frameName(frame) + "'";
  }
  const std::string pair = "'" + frameName(source) + "' to '" + frameName(target) + "'";
  return has(target, source, ros::Time()) ? "tf from " + pair + " does not reach its time"
                                          : "tf does not join " + pair;
}

}  // namespace cca
