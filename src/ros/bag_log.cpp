// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/ros/bag_log.hpp"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/ros/pose_message.hpp"
#include "cca_mrpt/ros/scan_message.hpp"
#include "cca_mrpt/ros/transforms.hpp"
#include "cca_mrpt/sensing/missing_returns.hpp"

namespace cca {
namespace {

constexpr const char* kMapFrame = "map";
constexpr const char* kOdomFrame = "odom";

/// All of a bag's: poses are wanted at times before the next one is read.
std::vector<Transforms::Message> transformsOf(const rosbag::Bag& bag) {
  std::vector<Transforms::Message> messages;
  rosbag::View view(bag, rosbag::TopicQuery({"/tf", "/tf_static", "tf", "tf_static"}));
  for (const auto& message : view) {
    const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
    const bool is_static = message.getTopic().find("static") != std::string::npos;
    if (transforms) messages.push_back({*transforms, is_static});
  }
  return messages;
}

/// The topics of one message type, the one with most messages first.
std::string busiestTopic(const rosbag::Bag& bag, const std::string& type) {
  std::map<std::string, std::size_t> messages;
  rosbag::View view(bag, rosbag::TypeQuery(type));
  for (const auto& message : view) ++messages[message.getTopic()];
  const auto busiest =
      std::max_element(messages.begin(), messages.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return busiest == messages.end() ? std::string() : busiest->first;
}

class BagLog : public LogReader {
 public:
  explicit BagLog(const std::string& path)
      : bag_(path, rosbag::bagmode::Read),
        transforms_(transformsOf(bag_)),
        view_(bag_, rosbag::TopicQuery({busiestTopic(bag_, "sensor_msgs/LaserScan"),
                                        busiestTopic(bag_, "nav_msgs/Odometry")})),
        at_(view_.begin()) {
    messages_ = std::max<std::size_t>(view_.size(), 1);
    base_ = transforms_.hasFrame("base_link")        ? "base_link"
            : transforms_.hasFrame("base_footprint") ? "base_footprint"
                                                     : "";
    has_map_ = !base_.empty() && find(kMapFrame, base_, ros::Time()).has_value();
  }

  std::optional<LogRecord> next() override try {
    return fault_.empty() ? nextReadable() : std::nullopt;
  } catch (const std::runtime_error& error) {  // rosbag's, from a damaged part of the file
    fault_ = std::string("unreadable from there on: ") + error.what();
    return std::nullopt;
  }

  std::string warnings() const override {
    std::string text = fault_;
    const auto tell = [&text](std::size_t count, const char* what) {
      if (count == 0) return;
      text += (text.empty() ? "" : "; ") + std::to_string(count) + " " + what + " left out";
    };
    tell(left_out_, "impossible or tilted scan(s)");
    tell(unplaced_, "scan(s) that tf has no pose in 'map' for");
    return text;
  }

  double progress() const override {
    return std::min(1.0, static_cast<double>(read_) / static_cast<double>(messages_));
  }

 private:
  std::optional<LogRecord> nextReadable() {
    for (; at_ != view_.end(); ++at_, ++read_) {
      if (const auto odometry = at_->instantiate<nav_msgs::Odometry>()) take(*odometry);
      const auto message = at_->instantiate<sensor_msgs::LaserScan>();
      if (!message) continue;
      auto record = makeRecord(*message);
      left_out_ += !record;
      if (!record || !place(*record)) continue;
      missing_returns_[frameName(message->header.frame_id)].judge(record->scan);
      ++at_;
      ++read_;
      return record;
    }
    return std::nullopt;
  }

  /// T_target_source; nothing where tf does not know it at that time, or it is not planar.
  std::optional<PlanarPose> find(const std::string& target, const std::string& source,
                                 const ros::Time& time) const try {
    if (!transforms_.has(target, source, time)) return std::nullopt;
    return transforms_.lookup(target, source, time);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }

  void take(const nav_msgs::Odometry& odometry) {
    geometry_msgs::Transform transform;
    transform.translation.x = odometry.pose.pose.position.x;
    transform.translation.y = odometry.pose.pose.position.y;
    transform.rotation = odometry.pose.pose.orientation;
    try {
      wheels_ = planarPose(transform).pose;
    } catch (const std::runtime_error&) {
      wheels_.reset();
    }
  }

  std::optional<LogRecord> makeRecord(const sensor_msgs::LaserScan& message) const {
    LogRecord record;
    ros::Time time;
    try {
      record.scan = scanFromMessage(message);
      time = sweepMiddle(message);
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
    record.time = time.toSec();
    record.has_time = !message.header.stamp.isZero();
    const std::string laser = frameName(message.header.frame_id);
    const std::string base = base_.empty() ? laser : base_;
    PlanarPose mounting;
    if (const auto found = find(base, laser, time)) {
      mounting = *found;
    } else if (transforms_.hasFrame(laser) && !base_.empty() && laser != base_) {
      return std::nullopt;
    }
    placeScan(record.scan, mounting);
    record.T_robot_sensor = mounting.pose;
    if (const auto pose = find(kMapFrame, base, time)) record.corrected = pose->pose;
    if (const auto pose = find(kOdomFrame, base, time)) record.odometry = pose->pose;
    if (!record.odometry) record.odometry = wheels_;
    // At once, as who listens to tf has it: put together from the others it differs in the last
    // bit.
    if (const auto pose = find(kMapFrame, laser, time)) {
      record.scan.T_map_sensor = pose->pose;
    } else if (record.corrected) {
      record.scan.T_map_sensor = *record.corrected * mounting.pose;
    }
    return record;
  }

  /// Puts the scan where the robot was. tf may end before the scans, or begin after them: where the
  /// bag knows `map`, a scan is not put into another frame instead.
  /// @return  whether that place is known.
  bool place(LogRecord& record) {
    if (record.corrected) return has_map_ = true;
    unplaced_ += has_map_;
    if (has_map_) return false;
    record.scan.T_map_sensor = record.odometry.value_or(Pose2()) * record.T_robot_sensor;
    return true;
  }

  rosbag::Bag bag_;
  Transforms transforms_;
  rosbag::View view_;
  rosbag::View::iterator at_;
  std::size_t messages_ = 1;
  std::string base_;
  bool has_map_ = false;  ///< tf knows the base in `map`, at some time
  std::optional<Pose2> wheels_;
  std::map<std::string, MissingReturns> missing_returns_;  ///< of each laser, by its frame
  std::string fault_;
  std::size_t read_ = 0, left_out_ = 0, unplaced_ = 0;
};

std::unique_ptr<LogReader> openBag(const std::string& path) {
  try {
    return std::make_unique<BagLog>(path);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": cannot be read as a ROS bag (" + error.what() +
                             "); 'rosbag reindex' may mend one that broke off");
  }
}

}  // namespace

void addBagLogs() {
  addLogKind({"ROS .bag", [](const std::string& head) { return head.rfind("#ROSBAG V", 0) == 0; },
              openBag});
}

}  // namespace cca
