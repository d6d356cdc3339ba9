// SPDX-License-Identifier: BSD-3-Clause
#include "transform_feed.hpp"

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
  transforms_.add(message, is_static);
  on_change_();
}

}  // namespace cca
