// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>

#include <optional>
#include <string>
#include <vector>

#include "ros/input/odometry_track.hpp"
#include "ros/input/transforms.hpp"

namespace rosbag {
class MessageInstance;
}

namespace cca {

/// A topic of a bag, and how many messages it has.
struct BagTopic {
  std::string name, type;
  std::size_t messages = 0;
};

/// Topics of these types, or all; in the order of their names.
std::vector<BagTopic> topicsOf(const rosbag::Bag& bag, const std::vector<std::string>& types = {});
/// The one with most messages, the first of these; nothing where there is none.
std::optional<BagTopic> busiest(const std::vector<BagTopic>& topics);
/// "'/scan' (sensor_msgs/LaserScan, 12 messages), ...".
std::string listed(const std::vector<BagTopic>& topics);

/// sensor_msgs/LaserScan, or of a sensor_msgs/MultiEchoLaserScan the first echoes; else nothing.
std::optional<sensor_msgs::LaserScan> scanOf(const rosbag::MessageInstance& message);

/// All of a bag's: poses are wanted at times before the next one is read.
std::vector<Transforms::Message> transformsOf(const rosbag::Bag& bag);

/// All of a topic's; none where it is empty.
OdometryTrack odometryOf(const rosbag::Bag& bag, const std::string& topic);

}  // namespace cca
