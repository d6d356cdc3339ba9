// SPDX-License-Identifier: BSD-3-Clause
#include "hazard_feed.hpp"

#include <stdexcept>

#include "ros/messages/hazard_message.hpp"

namespace cca {
namespace {

constexpr int kHazardQueue = 100;  // messages: those of a dozen sensors between two scans
constexpr std::size_t kMostHazards = 1000;
const ros::Duration kTransformDue(0.5);  // s

}  // namespace

HazardFeed::HazardFeed(ros::NodeHandle& node, const Settings& settings)
    : fixed_frame_(settings.fixed_frame) {
  const auto hear = [&](const std::string& topic, auto take) {
    if (topic.empty()) return;
    subscribers_.push_back(
        node.subscribe(topic, kHazardQueue, take, this, ros::TransportHints().tcpNoDelay()));
  };
  hear(settings.points, &HazardFeed::receive<sensor_msgs::PointCloud2>);
  hear(settings.range, &HazardFeed::receive<sensor_msgs::Range>);
}

template <class Message>
void HazardFeed::receive(const Message& message) {
  try {
    auto points = hazardPoints(message);
    if (points.empty()) return;
    waiting_.push_back({std::move(points), message.header.frame_id, message.header.stamp});
    if (waiting_.size() > kMostHazards) waiting_.pop_front();
  } catch (const std::runtime_error& error) {
    ROS_WARN_THROTTLE(5.0, "hazard dropped: %s", error.what());
  }
}

std::vector<Eigen::Vector2d> HazardFeed::around(const Eigen::Vector2d& robot_fixed,
                                                const ros::Time& now, const Transforms& tf) {
  std::deque<Waiting> waiting;
  std::swap(waiting, waiting_);
  for (Waiting& w : waiting) {
    if (!tf.has(fixed_frame_, w.frame, w.stamp)) {
      if (now - w.stamp < kTransformDue) {
        waiting_.push_back(std::move(w));
      } else {
        ROS_WARN_STREAM_THROTTLE(5.0, "hazard dropped: " << tf.whyNot(fixed_frame_, w.frame));
      }
      continue;
    }
    try {
      const Eigen::Isometry3d T = tf.lookupInSpace(fixed_frame_, w.frame, w.stamp);
      std::vector<Eigen::Vector2d> points;
      for (const Eigen::Vector3d& p : w.points) points.push_back((T * p).head<2>());
      memory_.add(points, w.stamp.isZero() ? now.toSec() : w.stamp.toSec());
    } catch (const std::runtime_error& error) {
      ROS_WARN_THROTTLE(5.0, "hazard dropped: %s", error.what());
    }
  }
  return memory_.around(robot_fixed, now.toSec());
}

}  // namespace cca
