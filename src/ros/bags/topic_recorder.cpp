// SPDX-License-Identifier: BSD-3-Clause
#include "topic_recorder.hpp"

#include <topic_tools/shape_shifter.h>

namespace cca {
namespace {

constexpr std::uint32_t kRecordQueue = 1000;  // a second of tf from many publishers

}  // namespace

TopicRecorder::TopicRecorder(ros::NodeHandle& node, const std::string& path,
                             const std::set<std::string>& topics)
    : bag_(path) {
  if (path.empty()) return;
  using Event = ros::MessageEvent<const topic_tools::ShapeShifter>;
  for (const std::string& topic : topics) {
    if (topic.empty()) continue;
    const std::string name = node.resolveName(topic);
    const auto write = [this, name](const Event& event) {
      const auto& header = event.getConnectionHeader();
      const auto latching = header.find("latching");
      const bool is_latched = latching != header.end() && latching->second == "1";
      bag_.write(name, event.getReceiptTime(), *event.getConstMessage(), is_latched);
    };
    subscribers_.push_back(node.subscribe<topic_tools::ShapeShifter, const Event&>(
        name, kRecordQueue, write, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }
}

std::set<std::string> topicsOfRobot(const std::vector<std::string>& scans) {
  std::set<std::string> topics(scans.begin(), scans.end());
  topics.insert({"/tf", "/tf_static", "odom", "cmd_vel", "corrected_path"});
  return topics;
}

}  // namespace cca
