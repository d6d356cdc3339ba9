// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>
#include <rosbag/bag.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <string>

namespace cca {

/// Writes a bag as rosbag does: `FILE.active` while it grows, FILE when it is whole. A recorder
/// without a file does nothing. A disk that fills up ends the recording, not the run.
class BagRecorder {
 public:
  BagRecorder() = default;
  /// @throws std::runtime_error where the file cannot be made, or is there already.
  explicit BagRecorder(const std::string& path);
  ~BagRecorder();
  BagRecorder(const BagRecorder&) = delete;
  BagRecorder& operator=(const BagRecorder&) = delete;

  /// @param latched  for `rosbag play` to give it to late subscribers, too.
  template <class Message>
  void write(const std::string& topic, const ros::Time& stamp, const Message& message,
             bool latched = false) {
    if (!bag_) return;
    const auto header = boost::make_shared<ros::M_string>();
    (*header)["topic"] = topic;
    (*header)["type"] = ros::message_traits::datatype(message);
    (*header)["md5sum"] = ros::message_traits::md5sum(message);
    (*header)["message_definition"] = ros::message_traits::definition(message);
    if (latched) (*header)["latching"] = "1";
    try {
      // Before the first word of a simulated clock it is no time yet.
      bag_->write(topic, std::max(stamp, ros::TIME_MIN), message, header);
    } catch (const rosbag::BagException& error) {
      giveUp(error.what());
    }
  }

 private:
  /// What has been written stays.
  void giveUp(const char* why);

  std::string path_;
  std::unique_ptr<rosbag::Bag> bag_;
};

}  // namespace cca
