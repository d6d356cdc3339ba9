// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include "exploration.hpp"
#include "node_diagnostics.hpp"
#include "scan_feed.hpp"
#include "simulated_robot.hpp"

namespace cca {

/// Explores with a robot that is out there: `scan`, tf and, where there is one, `odom` in,
/// `cmd_vel` out. It never drives blind: where no usable scan has come for `scan_timeout`, or
/// nobody listens to cmd_vel, the command is zero, and the exploration goes on when they are back.
class RobotDriver {
 public:
  struct Settings {
    FrameNames frames;
    double scan_timeout = 0.3;  ///< s
    bool publish_map_to_odom = false;
  };

  RobotDriver(ros::NodeHandle& node, ros::NodeHandle& private_node, const Settings& settings,
              Exploration& exploration);
  /// Leaves the robot standing.
  ~RobotDriver();
  RobotDriver(const RobotDriver&) = delete;
  RobotDriver& operator=(const RobotDriver&) = delete;

 private:
  void use(const PlacedScan& placed);
  void watch();
  void command(const Velocity& velocity);
  Velocity measuredVelocity() const;
  void publishMapToOdom(ros::NodeHandle& node);

  Settings settings_;
  Exploration& exploration_;
  ros::Publisher commands_, fixed_transforms_;
  ros::Subscriber odometry_;
  nav_msgs::Odometry last_odometry_;
  Velocity command_;
  ros::Time last_step_;
  ros::WallTime last_moving_;
  ScanFeed scans_;
  NodeDiagnostics diagnostics_;
  ros::Timer watchdog_;
};

}  // namespace cca
