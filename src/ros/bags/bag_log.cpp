// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/bag_log.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "bag_places.hpp"
#include "bag_topics.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/sensing/missing_returns.hpp"
#include "io/files/text.hpp"
#include "ros/messages/scan_message.hpp"

namespace cca {
namespace {

class BagLog : public LogReader {
 public:
  BagLog(const std::string& path, const LogHints& hints)
      : bag_(path, rosbag::bagmode::Read),
        topic_(laserTopic(hints.topic)),
        odometry_topic_(busiest(topicsOf(bag_, {"nav_msgs/Odometry"})).value_or(BagTopic()).name),
        places_(transformsOf(bag_), odometryOf(bag_, odometry_topic_), hints),
        view_(bag_, rosbag::TopicQuery({topic_, odometry_topic_})),
        at_(view_.begin()) {
    messages_ = std::max<std::size_t>(view_.size(), 1);
  }

  std::optional<LogRecord> next() override try {
    return fault_.empty() ? nextReadable() : std::nullopt;
  } catch (const std::runtime_error& error) {  // rosbag's, from a damaged part of the file
    fault_ = std::string("unreadable from there on: ") + error.what();
    return std::nullopt;
  }

  std::string warnings() const override {
    std::string text = fault_;
    appendWarning(of_topics_, text);
    for (const auto& [rule, fault] : left_out_) {
      appendWarning(std::to_string(fault.scans) + " impossible scan(s) left out: " + fault.first,
                    text);
    }
    appendWarning(places_.warnings(), text);
    return text;
  }

  double progress() const override {
    return std::min(1.0, static_cast<double>(read_) / static_cast<double>(messages_));
  }

 private:
  /// @param asked  empty: the one with most scans.
  std::string laserTopic(const std::string& asked) {
    const std::vector<BagTopic> lasers =
        topicsOf(bag_, {"sensor_msgs/LaserScan", "sensor_msgs/MultiEchoLaserScan"});
    if (lasers.empty()) of_topics_ = "topics: " + listed(topicsOf(bag_));
    const auto is_asked = [&](const BagTopic& topic) {  // with or without its slash
      return frameName(topic.name) == frameName(asked);
    };
    const auto found = std::find_if(lasers.begin(), lasers.end(), is_asked);
    if (!asked.empty() && found == lasers.end()) {
      throw std::runtime_error("topic '" + asked + "' holds no laser scans; these do: " +
                               (lasers.empty() ? "none" : listed(lasers)));
    }
    const std::string topic =
        asked.empty() ? busiest(lasers).value_or(BagTopic()).name : found->name;
    if (lasers.size() > 1) {
      of_topics_ =
          "the scans are those of '" + topic + "' alone (--topic chooses), of " + listed(lasers);
    }
    return topic;
  }

  std::optional<LogRecord> nextReadable() {
    for (; at_ != view_.end(); ++at_, ++read_) {
      if (const auto odometry = at_->instantiate<nav_msgs::Odometry>()) places_.take(*odometry);
      const auto message = scanOf(*at_);
      if (!message) continue;
      auto record = makeRecord(*message);
      if (!record) continue;
      ++at_;
      ++read_;
      return record;
    }
    return std::nullopt;
  }

  std::optional<LogRecord> makeRecord(const sensor_msgs::LaserScan& message) try {
    LogRecord record;
    record.scan = scanFromMessage(message);
    const ros::Time time = sweepMiddle(message);
    record.time = time.toSec();
    record.has_time = !message.header.stamp.isZero();
    const std::string laser = frameName(message.header.frame_id);
    if (!places_.place(record, laser, time)) return std::nullopt;
    missing_returns_[laser].judge(record.scan);
    return record;
  } catch (const MalformedScan& fault) {
    return leaveOut(fault.rule(), fault.what());
  } catch (const std::runtime_error& error) {
    return leaveOut(error.what(), error.what());
  }

  std::nullopt_t leaveOut(const std::string& rule, const std::string& text) {
    Fault& fault = left_out_[rule];
    if (++fault.scans == 1) fault.first = text;
    return std::nullopt;
  }

  struct Fault {
    std::size_t scans = 0;
    std::string first;
  };

  rosbag::Bag bag_;
  std::string of_topics_;  ///< what people should know of them
  std::string topic_, odometry_topic_;
  BagPlaces places_;
  rosbag::View view_;
  rosbag::View::iterator at_;
  std::size_t messages_ = 1, read_ = 0;
  std::map<std::string, MissingReturns> missing_returns_;  ///< of each laser, by its frame
  std::map<std::string, Fault> left_out_;                  ///< by the rule that is broken
  std::string fault_;
};

std::unique_ptr<LogReader> openBag(const std::string& file, const LogHints& hints) {
  try {
    return std::make_unique<BagLog>(file, hints);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(std::string("cannot be read as a ROS bag (") + error.what() +
                             "); 'rosbag reindex' may mend one that broke off");
  }
}

}  // namespace

void addBagLogs() {
  addLogKind({"ROS .bag", [](const std::string& head) { return head.rfind("#ROSBAG V", 0) == 0; },
              openBag});
}

}  // namespace cca
