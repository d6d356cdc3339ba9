// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <ros/ros.h>

#include <string>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// `trajectory`: where the robot has been, a pose every 5 cm or 0.2 rad; latched.
class WayPublisher {
 public:
  WayPublisher(ros::NodeHandle& node, const std::string& frame);

  void add(const Pose2& T_map_robot, const ros::Time& stamp);
  /// This is the way so far, and what was added is forgotten.
  /// @param times  s, of each pose.
  void replace(const std::vector<double>& times, const std::vector<Pose2>& T_map_robot);
  void publish(const ros::Time& stamp);

 private:
  nav_msgs::Path way_;
  ros::Publisher publisher_;
};

}  // namespace cca
