// SPDX-License-Identifier: BSD-3-Clause
#include "robot_driver.hpp"

#include <geometry_msgs/Twist.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>

#include "cca_mrpt/ros/pose_message.hpp"

namespace cca {
namespace {

constexpr double kWatchPeriod = 0.05;    // s
constexpr double kOldestScan = 0.5;      // s; the world has moved on since
constexpr double kOldestOdometry = 0.3;  // s
const ros::WallDuration kInsist(1.0);    // zero is said for so long, then others may drive

}  // namespace

RobotDriver::RobotDriver(ros::NodeHandle& node, ros::NodeHandle& private_node,
                         const Settings& settings, Exploration& exploration)
    : settings_(settings),
      exploration_(exploration),
      commands_(node.advertise<geometry_msgs::Twist>("cmd_vel", 1)),
      last_moving_(ros::WallTime::now()),
      scans_(node, {settings.frames.map, settings.frames.base}, kOldestScan,
             [this](const PlacedScan& placed) { use(placed); }),
      diagnostics_(
          node, private_node, [this]() -> const auto& { return scans_.dropped(); }) {
  if (settings_.publish_map_to_odom) publishMapToOdom(node);
  odometry_ = node.subscribe<nav_msgs::Odometry>(
      "odom", 10, [this](const nav_msgs::Odometry::ConstPtr& m) { last_odometry_ = *m; },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  watchdog_ =
      node.createTimer(ros::Duration(kWatchPeriod), [this](const ros::TimerEvent&) { watch(); });
}

RobotDriver::~RobotDriver() {
  watchdog_.stop();
  command({});
  ros::WallDuration(0.1).sleep();  // for the message to leave before the connection does
}

void RobotDriver::publishMapToOdom(ros::NodeHandle& node) {
  fixed_transforms_ = node.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.stamp = ros::Time::now();
  message.transforms[0].header.frame_id = settings_.frames.map;
  message.transforms[0].child_frame_id = settings_.frames.odom;
  message.transforms[0].transform = transformMessage({});
  fixed_transforms_.publish(message);
}

Velocity RobotDriver::measuredVelocity() const {
  const auto& twist = last_odometry_.twist.twist;
  const double age = (ros::Time::now() - last_odometry_.header.stamp).toSec();
  const bool usable = std::abs(age) < kOldestOdometry && std::isfinite(twist.linear.x) &&
                      std::isfinite(twist.angular.z);
  return usable ? Velocity{twist.linear.x, twist.angular.z} : command_;
}

void RobotDriver::use(const PlacedScan& placed) {
  if (commands_.getNumSubscribers() == 0) {
    if (exploration_.drives()) exploration_.wait("nobody listens to cmd_vel");
    return;
  }
  const ros::WallTime begin = ros::WallTime::now();
  const Observation observation{placed.scan, placed.T_map_robot, measuredVelocity(),
                                placed.stamp.toSec()};
  command(exploration_.step(observation, placed.stamp));
  // The clock of the laser's computer may be ahead of ours: that is no clock set back.
  last_step_ = std::min(placed.stamp, ros::Time::now());
  diagnostics_.scanUsed((ros::WallTime::now() - begin).toSec(), exploration_.agreement());
}

void RobotDriver::watch() {
  const double age = (ros::Time::now() - last_step_).toSec();
  if (age < 0.0) last_step_ = ros::Time();  // the clock was set back
  const bool blind = age < 0.0 || age > settings_.scan_timeout;
  if (blind && exploration_.drives() && commands_.getNumSubscribers() > 0) {
    exploration_.wait("no usable scan" + scans_.lastTrouble());
  }
  command(blind || !exploration_.drives() ? Velocity{} : command_);
  diagnostics_.setState(exploration_.state());
}

void RobotDriver::command(const Velocity& velocity) {
  const ros::WallTime now = ros::WallTime::now();
  const bool moving = velocity.linear != 0.0 || velocity.angular != 0.0;
  command_ = velocity;
  if (moving || exploration_.drives()) last_moving_ = now;
  if (now - last_moving_ > kInsist) return;
  geometry_msgs::Twist twist;
  twist.linear.x = velocity.linear;
  twist.angular.z = velocity.angular;
  commands_.publish(twist);
}

}  // namespace cca
