// SPDX-License-Identifier: BSD-3-Clause
#include "transform_feed.hpp"

namespace cca {
namespace {

constexpr int kTransformQueue =
    20000;  // messages; those of a busy robot within three seconds at 40 x speed

}  // namespace

TransformFeed::TransformFeed(ros::NodeHandle& node, std::function<void()> on_change)
    : on_change_(std::move(on_change)) {
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  using Message = tf2_msgs::TFMessage;
  moving_ = node.subscribe<Message>(
      "/tf", kTransformQueue, [this](const Message::ConstPtr& m) { take(*m, false); },
      ros::VoidConstPtr(), no_delay);
  fixed_ = node.subscribe<Message>(
      "/tf_static", kTransformQueue, [this](const Message::ConstPtr& m) { take(*m, true); },
      ros::VoidConstPtr(), no_delay);
}

void TransformFeed::take(const tf2_msgs::TFMessage& message, bool is_static) {
  transforms_.add(message, is_static);
  on_change_();
}

}  // namespace cca
