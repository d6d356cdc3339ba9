// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <Eigen/Core>
#include <deque>
#include <string>
#include <vector>

#include "ros/input/transforms.hpp"
#include "sensing/hazard_memory.hpp"

namespace cca {

/// Bumpers, cliff sensors and the like: what they have met, in the fixed frame. Where they are
/// silent, nothing is there: many tell of a contact only. Lives in the thread that spins.
class HazardFeed {
 public:
  struct Settings {
    std::string points, range;  ///< topics of sensor_msgs/PointCloud2 and Range; empty: none
    std::string fixed_frame = "map";
  };

  HazardFeed(ros::NodeHandle& node, const Settings& settings);

  /// m, fixed frame, of the last minute. Messages wait until tf has come to their stamp, for half a
  /// second; then they are dropped, and that is told.
  std::vector<Eigen::Vector2d> around(const Eigen::Vector2d& robot_fixed, const ros::Time& now,
                                      const Transforms& tf);

  /// See HazardMemory::move().
  void move(const Pose2& T_now_was) { memory_.move(T_now_was); }

 private:
  struct Waiting {
    std::vector<Eigen::Vector3d> points;  ///< m, frame of the sensor
    std::string frame;
    ros::Time stamp;
  };
  template <class Message>
  void receive(const Message& message);

  std::string fixed_frame_;
  std::deque<Waiting> waiting_;
  HazardMemory memory_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace cca
