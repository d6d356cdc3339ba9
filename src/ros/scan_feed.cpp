// SPDX-License-Identifier: BSD-3-Clause
#include "scan_feed.hpp"

#include <algorithm>
#include <stdexcept>

#include "cca_mrpt/ros/scan_message.hpp"

namespace cca {
namespace {

constexpr double kSmallestSeeingFraction = 0.1;  // below it a laser is covered or broken
constexpr double kFurthestFuture = 1.0;          // s; clocks of two computers differ by less
constexpr std::size_t kLongestQueue = 50;        // scans that wait for tf
constexpr double kLongWait = 1.0;                // s; no localisation takes as long

}  // namespace

ScanFeed::ScanFeed(ros::NodeHandle& node, Frames frames, double oldest, Sink sink)
    : frames_(std::move(frames)),
      oldest_(oldest),
      sink_(std::move(sink)),
      transforms_(node, [this] { serve(); }) {
  scans_ = node.subscribe<sensor_msgs::LaserScan>(
      "scan", 100, [this](const sensor_msgs::LaserScan::ConstPtr& m) { receive(*m); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

void ScanFeed::drop(const std::string& reason, const std::string& detail) {
  ++dropped_[reason];
  last_trouble_ = ": " + reason;
  ROS_WARN_STREAM_THROTTLE(5.0,
                           "scan dropped: " << reason << (detail.empty() ? "" : ": ") << detail);
}

void ScanFeed::startAnewIfClockWasSetBack() {
  const ros::Time now = ros::Time::now();
  if (now < last_now_) {
    ROS_WARN("the clock was set back: waiting for new transforms and scans");
    transforms_.clear();
    waiting_.clear();
    last_stamp_ = ros::Time();
    gate_ = PoseGate();
  }
  last_now_ = now;
}

/// A bag's first scan may come before its first clock message; only who drives has to wait.
bool ScanFeed::isFromTheFuture(const ros::Time& stamp) const {
  const ros::Time now = ros::Time::now();
  if (now.isZero() && oldest_ == 0.0) return false;
  return (stamp - now).toSec() > kFurthestFuture;
}

void ScanFeed::receive(const sensor_msgs::LaserScan& message) {
  startAnewIfClockWasSetBack();
  try {
    Waiting waiting{scanFromMessage(message), message.header.stamp, sweepMiddle(message),
                    message.header.frame_id};
    if (seeingFraction(waiting.scan) < kSmallestSeeingFraction) return drop("blind");
    if (waiting.stamp <= last_stamp_) return drop("not newer than the last");
    if (isFromTheFuture(waiting.stamp)) return drop("from the future");
    last_stamp_ = waiting.stamp;
    waiting_.push_back(std::move(waiting));
  } catch (const std::runtime_error& error) {
    return drop("malformed", error.what());
  }
  serve();
}

bool ScanFeed::hasPose(const Waiting& w) const {
  const Transforms& tf = transforms_.transforms();
  return tf.has(frames_.map, w.frame, w.middle) &&
         (frames_.robot.empty() || tf.has(frames_.map, frames_.robot, w.middle));
}

std::string ScanFeed::whyNoPose(const Waiting& w) const {
  const Transforms& tf = transforms_.transforms();
  const bool lacks_laser = !tf.has(frames_.map, w.frame, w.middle);
  return tf.whyNot(frames_.map, lacks_laser ? w.frame : frames_.robot);
}

void ScanFeed::serve() {
  const auto has_pose = [this](const Waiting& w) { return hasPose(w); };
  for (;;) {
    const auto next = std::find_if(waiting_.begin(), waiting_.end(), has_pose);
    if (next == waiting_.end()) break;
    // tf comes in the order of time: what stands before a scan with a pose will never have one.
    for (auto n = next - waiting_.begin(); n > 0; --n) dropFirst();
    const Waiting scan = std::move(waiting_.front());
    waiting_.pop_front();
    use(scan);
  }
  while (waiting_.size() > kLongestQueue) dropFirst();
  if (waiting_.empty()) return;
  const std::string why = whyNoPose(waiting_.front());
  last_trouble_ = ": " + why;
  if ((waiting_.back().stamp - waiting_.front().stamp).toSec() > kLongWait) {
    ROS_WARN_STREAM_THROTTLE(5.0, "scans wait for their pose: " << why);
  }
}

void ScanFeed::dropFirst() {
  const std::string why = whyNoPose(waiting_.front());
  waiting_.pop_front();
  drop("no transform", why);
}

void ScanFeed::use(const Waiting& waiting) {
  if (oldest_ > 0.0 && (ros::Time::now() - waiting.stamp).toSec() > oldest_) return drop("too old");
  PlacedScan placed{waiting.scan, {}, waiting.stamp, waiting.frame};
  try {
    placeScan(placed.scan,
              transforms_.transforms().lookup(frames_.map, waiting.frame, waiting.middle));
    placed.T_map_robot =
        frames_.robot.empty()
            ? placed.scan.T_map_sensor
            : transforms_.transforms().lookup(frames_.map, frames_.robot, waiting.middle).pose;
  } catch (const std::runtime_error& error) {
    return drop("no usable transform", error.what());
  }
  const auto verdict = gate_.check(placed.T_map_robot, waiting.stamp.toSec());
  if (verdict == PoseGate::Verdict::kHeld) return drop("the pose leapt");
  if (verdict == PoseGate::Verdict::kMoved) ROS_WARN("the pose leapt, and stays: going on there");
  last_trouble_.clear();
  missing_returns_.judge(placed.scan);
  sink_(placed);
}

}  // namespace cca
