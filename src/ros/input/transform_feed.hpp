// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <functional>

#include "ros/input/transforms.hpp"

namespace cca {

/// tf, in the node's own thread and with a call after each message that brought some. (The listener
/// of tf2_ros gives neither; a scan that waits for its pose is then served the moment that it
/// comes.)
class TransformFeed {
 public:
  TransformFeed(ros::NodeHandle& node, std::function<void()> on_change);

  const Transforms& transforms() const { return transforms_; }
  /// Forgets all but the static transforms: the clock has been set back.
  void clear() { transforms_.clear(); }

 private:
  Transforms transforms_;
  std::function<void()> on_change_;
  ros::Subscriber moving_, fixed_;
};

}  // namespace cca
