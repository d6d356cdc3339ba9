// SPDX-License-Identifier: BSD-3-Clause
#include "transform_feed.hpp"

#include <tf2/exceptions.h>

#include <stdexcept>

namespace cca {

TransformFeed::TransformFeed(ros::NodeHandle& node, std::function<void()> on_change)
    : on_change_(std::move(on_change)) {
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  using Message = tf2_msgs::TFMessage;
  moving_ = node.subscribe<Message>(
      "/tf", 200, [this](const Message::ConstPtr& m) { take(*m, false); }, ros::VoidConstPtr(),
      no_delay);
  fixed_ = node.subscribe<Message>(
      "/tf_static", 200, [this](const Message::ConstPtr& m) { take(*m, true); },
      ros::VoidConstPtr(), no_delay);
}

void TransformFeed::take(const tf2_msgs::TFMessage& message, bool is_static) {
  for (const auto& transform : message.transforms) {
    // tf2 itself refuses what is not finite, and says so on the console.
    buffer_.setTransform(transform, "tf", is_static);
  }
  on_change_();
}

bool TransformFeed::knows(const std::string& target, const std::string& source,
                          const ros::Time& time, std::string* why_not) const {
  return buffer_.canTransform(target, source, time, why_not);
}

PlanarPose TransformFeed::lookup(const std::string& target, const std::string& source,
                                 const ros::Time& time) const {
  try {
    return planarPose(buffer_.lookupTransform(target, source, time).transform);
  } catch (const tf2::TransformException& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace cca
