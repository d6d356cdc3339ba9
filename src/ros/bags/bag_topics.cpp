// SPDX-License-Identifier: BSD-3-Clause
#include "bag_topics.hpp"

#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <map>

#include "ros/messages/scan_message.hpp"

namespace cca {

std::vector<BagTopic> topicsOf(const rosbag::Bag& bag, const std::vector<std::string>& types) {
  rosbag::View view;
  types.empty() ? view.addQuery(bag) : view.addQuery(bag, rosbag::TypeQuery(types));
  std::map<std::string, BagTopic> topics;
  for (const auto* connection : view.getConnections()) {
    topics[connection->topic] = {connection->topic, connection->datatype};
  }
  for (const auto& message : view) ++topics[message.getTopic()].messages;
  std::vector<BagTopic> listed;
  for (const auto& [name, topic] : topics) listed.push_back(topic);
  return listed;
}

std::optional<BagTopic> busiest(const std::vector<BagTopic>& topics) {
  const auto busiest = std::max_element(
      topics.begin(), topics.end(),
      [](const BagTopic& a, const BagTopic& b) { return a.messages < b.messages; });
  if (busiest == topics.end()) return std::nullopt;
  return *busiest;
}

std::string listed(const std::vector<BagTopic>& topics) {
  std::string text;
  for (const BagTopic& topic : topics) {
    text += (text.empty() ? "'" : ", '") + topic.name + "' (" + topic.type + ", " +
            std::to_string(topic.messages) + " messages)";
  }
  return text;
}

std::optional<sensor_msgs::LaserScan> scanOf(const rosbag::MessageInstance& message) {
  if (const auto scan = message.instantiate<sensor_msgs::LaserScan>()) return *scan;
  if (const auto echoes = message.instantiate<sensor_msgs::MultiEchoLaserScan>()) {
    return firstEchoes(*echoes);
  }
  return std::nullopt;
}

std::vector<Transforms::Message> transformsOf(const rosbag::Bag& bag) {
  // Of several robots, each may have its own; where there is one for all, that is it.
  std::vector<std::string> topics, of_all{"/tf", "/tf_static", "tf", "tf_static"};
  for (const auto& topic : topicsOf(bag, {"tf2_msgs/TFMessage", "tf/tfMessage"})) {
    topics.push_back(topic.name);
  }
  const bool is_for_all = std::find_first_of(topics.begin(), topics.end(), of_all.begin(),
                                             of_all.end()) != topics.end();
  std::vector<Transforms::Message> messages;
  rosbag::View view(bag, rosbag::TopicQuery(is_for_all ? of_all : topics));
  for (const auto& message : view) {
    const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
    const bool is_static = message.getTopic().find("static") != std::string::npos;
    if (transforms) messages.push_back({*transforms, is_static});
  }
  return messages;
}

OdometryTrack odometryOf(const rosbag::Bag& bag, const std::string& topic) {
  OdometryTrack track;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const auto& message : view) {
    if (const auto odometry = message.instantiate<nav_msgs::Odometry>()) track.add(*odometry);
  }
  return track;
}

}  // namespace cca
