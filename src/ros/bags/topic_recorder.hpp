// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <set>
#include <string>
#include <vector>

#include "bag_recorder.hpp"

namespace cca {

/// Records topics of any type into a bag as they come: what a run on a robot is repeated from.
/// Lives in the thread that spins.
class TopicRecorder {
 public:
  /// @param path    of the bag; empty: nothing is recorded.
  /// @param topics  as the node names them; empty names are passed over.
  /// @throws std::runtime_error where the file cannot be made, or is there already.
  TopicRecorder(ros::NodeHandle& node, const std::string& path,
                const std::set<std::string>& topics);

 private:
  BagRecorder bag_;
  std::vector<ros::Subscriber> subscribers_;
};

/// What a node that maps or drives by these lasers is told: the scans, tf, odometry, commands.
std::set<std::string> topicsOfRobot(const std::vector<std::string>& scans);

}  // namespace cca
