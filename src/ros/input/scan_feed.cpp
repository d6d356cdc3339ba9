// SPDX-License-Identifier: BSD-3-Clause
#include "scan_feed.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "ros/messages/scan_message.hpp"

namespace cca {
namespace {

constexpr double kSmallestSeeingFraction = 0.1;  // below it a laser is covered or broken
constexpr double kFurthestFuture = 1.0;          // s; clocks of two computers differ by less
constexpr double kLongWait = 1.0;                // s; no localisation takes as long
// Scans that have come, and that wait for tf: a mapper may be seconds behind a bag played 40 times
// as fast. Who drives has no use for scans of seconds ago.
constexpr std::uint32_t kQueue = 5000;
const ros::WallDuration kPatience(5.0);  // launch files start mapper and robot together
constexpr std::size_t kMostWaiting = 5000, kMostWaitingToDrive = 50;

}  // namespace

sensor_msgs::LaserScan scanOf(const topic_tools::ShapeShifter& message) try {
  if (message.getDataType() == "sensor_msgs/MultiEchoLaserScan") {
    return firstEchoes(*message.instantiate<sensor_msgs::MultiEchoLaserScan>());
  }
  return *message.instantiate<sensor_msgs::LaserScan>();
} catch (const ros::Exception&) {
  throw std::runtime_error("a " + message.getDataType() + " is no scan");
}

ScanFeed::ScanFeed(ros::NodeHandle& node, Settings settings, Sink sink)
    : settings_(std::move(settings)),
      sink_(std::move(sink)),
      periods_(settings_.topics.size()),
      transforms_(node, [this] { serve(); }) {
  for (std::size_t topic = 0; topic < settings_.topics.size(); ++topic) {
    const auto take = [this, topic](const Event& event) { receive(event, topic); };
    scans_.push_back(node.subscribe<topic_tools::ShapeShifter, const Event&>(
        settings_.topics[topic], kQueue, take, ros::VoidConstPtr(),
        ros::TransportHints().tcpNoDelay()));
  }
  silence_timer_ = node.createWallTimer(kPatience, [this](const ros::WallTimerEvent&) {
    const std::string why = whySilent();
    if (!why.empty() && why != told_silence_) ROS_WARN_STREAM(why);
    told_silence_ = why;
  });
}

void ScanFeed::drop(const std::string& reason, const std::string& detail, const std::string& rule) {
  ++dropped_[reason];
  last_trouble_ = ": " + reason;
  const std::string text = "scan dropped: " + reason + (detail.empty() ? "" : ": ") + detail;
  if (told_.insert(reason + rule).second) {
    ROS_WARN_STREAM(text);
  } else {
    ROS_WARN_STREAM_THROTTLE(5.0, text);
  }
}

std::string ScanFeed::whySilent() const {
  if (ros::Time::isSimTime() && ros::Time::now().isZero()) {
    return "use_sim_time is true, and nothing gives /clock";
  }
  for (const ros::Subscriber& scans : scans_) {
    if (scans.getNumPublishers() == 0) return "nobody publishes " + scans.getTopic();
  }
  return "";
}

std::string ScanFeed::lastTrouble() const {
  const std::string silence = whySilent();
  return silence.empty() ? last_trouble_ : ": " + silence;
}

void ScanFeed::startAnewIfClockWasSetBack() {
  const ros::Time now = ros::Time::now();
  if (now < last_now_) {
    ROS_WARN("the clock was set back: waiting for new transforms and scans");
    transforms_.clear();
    waiting_.clear();
    last_stamps_.clear();
    gate_ = PoseGate();
  }
  last_now_ = now;
}

std::string ScanFeed::whyUnfit(const PlacedScan& w) const {
  if (seeingFraction(w.scan) < kSmallestSeeingFraction) return "blind";
  const auto last = last_stamps_.find(w.frame);
  if (last != last_stamps_.end() && w.stamp <= last->second) return "not newer than the last";
  if ((w.stamp - ros::Time::now()).toSec() > kFurthestFuture) return "from the future";
  return "";
}

void ScanFeed::receive(const Event& event, std::size_t topic) {
  startAnewIfClockWasSetBack();
  try {
    const sensor_msgs::LaserScan message = scanOf(*event.getConstMessage());
    PlacedScan waiting{scanFromMessage(message),
                       message.header.stamp,
                       sweepMiddle(message),
                       event.getReceiptTime(),
                       frameName(message.header.frame_id),
                       topic};
    periods_[topic].add(message.header.stamp);
    if (waiting.frame.empty()) return drop("malformed", "header.frame_id is empty", "frame_id");
    if (waiting.stamp.isZero()) return drop("malformed", "header.stamp is 0", "stamp");
    if (drives()) {
      const std::string why = whyUnfit(waiting);
      if (!why.empty()) return drop(why);
      last_stamps_[waiting.frame] = waiting.stamp;
    }
    waiting_.push_back(std::move(waiting));
  } catch (const MalformedScan& error) {
    return drop("malformed", error.what(), error.rule());
  } catch (const std::runtime_error& error) {
    return drop("malformed", error.what());
  }
  serve();
}

std::optional<ros::Time> ScanFeed::latestPose(const std::string& laser_frame) const {
  const Transforms& tf = transforms_.transforms();
  const auto laser = tf.latest(settings_.frames.fixed, laser_frame);
  if (settings_.frames.base.empty() || !laser) return laser;
  const auto robot = tf.latest(settings_.frames.fixed, settings_.frames.base);
  return robot ? std::min(laser, robot) : robot;
}

/// tf comes in the order of time: a time that it has passed, and knows no pose for, it never will.
ScanFeed::Pose ScanFeed::pose(const PlacedScan& w, const std::optional<ros::Time>& latest) const {
  // Who maps can wait until tf has come to the end of the sweep: what is undone does not depend on
  // how late it is.
  const bool waits = !drives() && !is_at_end_;
  const ros::Duration rest = waits ? halfSweep(w.scan.sweep_duration) : ros::Duration(0.0);
  if (!latest || (!latest->isZero() && w.middle + rest > *latest)) return Pose::kExpected;
  if (hasPlacement(transforms_.transforms(), settings_.frames, w.frame, w.middle))
    return Pose::kKnown;
  return w.middle <= *latest ? Pose::kNever : Pose::kExpected;
}

std::string ScanFeed::whyNoPose(const PlacedScan& w) const {
  const Transforms& tf = transforms_.transforms();
  const bool lacks_laser = !tf.has(settings_.frames.fixed, w.frame, w.middle);
  return tf.whyNot(settings_.frames.fixed, lacks_laser ? w.frame : settings_.frames.base);
}

void ScanFeed::serve() {
  if (waiting_.empty()) return;
  const std::size_t most = drives() ? kMostWaitingToDrive : kMostWaiting;
  std::map<std::string, std::optional<ros::Time>> latest;
  std::deque<PlacedScan> waiting;
  std::swap(waiting, waiting_);
  for (PlacedScan& w : waiting) {
    const auto [at, is_new] = latest.try_emplace(w.frame);
    if (is_new) at->second = latestPose(w.frame);
    const Pose known = pose(w, at->second);
    if (known == Pose::kKnown) use(w);
    if (known == Pose::kNever) drop("no transform", whyNoPose(w));
    if (known == Pose::kExpected) waiting_.push_back(std::move(w));
  }
  while (waiting_.size() > most) {
    drop("no transform", whyNoPose(waiting_.front()));
    waiting_.pop_front();
  }
  if (waiting_.empty()) return;
  const std::string why = whyNoPose(waiting_.front());
  last_trouble_ = ": " + why;
  if ((waiting_.back().stamp - waiting_.front().stamp).toSec() > kLongWait) {
    ROS_WARN_STREAM_THROTTLE(5.0, "scans wait for their pose: " << why);
  }
}

void ScanFeed::finish() {
  is_at_end_ = true;
  serve();
}

void ScanFeed::use(PlacedScan& placed) {
  const double oldest = periods_[placed.topic].oldest(settings_.oldest);
  if (drives() && (ros::Time::now() - placed.stamp).toSec() > oldest) return drop("too old");
  try {
    placed.at = placeByTf(placed.scan, transforms_.transforms(), settings_.frames, placed.frame,
                          placed.middle);
  } catch (const std::runtime_error& error) {
    return drop("no usable transform", error.what());
  }
  const ScanFault fault = faults_[placed.frame].check(placed.scan, placed.at.T_odom_robot);
  if (fault == ScanFault::kRepeated) return drop("repeated though the wheels went on");
  if (fault == ScanFault::kMillimetres) {
    return drop("ranges look like millimetres",
                "median " + std::to_string(medianReturn(placed.scan)));
  }
  if (drives()) {
    const auto verdict = gate_.check(placed.at.T_fixed_robot, placed.stamp.toSec());
    if (verdict == PoseGate::Verdict::kHeld) return drop("the pose leapt");
    if (verdict == PoseGate::Verdict::kMoved) ROS_WARN("the pose leapt, and stays: going on there");
  }
  last_trouble_.clear();
  missing_returns_[placed.frame].judge(placed.scan);
  sink_(placed);
}

}  // namespace cca
