// SPDX-License-Identifier: BSD-3-Clause
#include "transform_feed.hpp"

namespace cca {
namespace {

constexpr int kTransformQueue =
    20000;  // messages; those of a busy robot within three seconds at 40 x speed

}  // namespace

TransformFeed::TransformFeed(ros::NodeHandle& node, std::function<void()> on_change)
    : on_change_(std::move(on_change)) {
  using Message = tf2_msgs::TFMessage;
  const auto hear = [&](const char* topic, bool is_static) {
    const auto take = [this, is_static](const Message::ConstPtr& message) {
      transforms_.add(*message, is_static);
      on_change_();
    };
    return node.subscribe<Message>(topic, kTransformQueue, take, ros::VoidConstPtr(),
                                   ros::TransportHints().tcpNoDelay());
  };
  moving_ = hear("/tf", false);
  fixed_ = hear("/tf_static", true);
}

}  // namespace cca
