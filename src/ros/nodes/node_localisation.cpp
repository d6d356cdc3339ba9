// SPDX-License-Identifier: BSD-3-Clause
#include "node_localisation.hpp"

#include <utility>

#include "cca_mrpt/localisation/given_poses.hpp"
#include "node_main.hpp"
#include "ros/input/transform_feed.hpp"
#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

const ros::WallDuration kPoseAwaited(5.0);  // localisations tell a pose with their first scans

}  // namespace

std::unique_ptr<Localiser> makeLocaliser(const std::string& pose, bool corrections,
                                         const CcaParameters& mapping) {
  if (pose == "slam") return std::make_unique<SlamLocaliser>();
  if (pose == "tf" && corrections) return std::make_unique<ExternalCorrections>(mapping);
  return std::make_unique<GivenPoses>();
}

Measurement measurementOf(const PlacedScan& placed, bool is_in_odometry) {
  Measurement measurement;
  measurement.scan = placed.scan;
  measurement.T_robot_sensor = placed.at.T_robot_sensor;
  measurement.time = placed.middle.toSec();
  measurement.motion = placed.at.motion;
  if (is_in_odometry) {
    measurement.T_odom_robot = placed.at.T_fixed_robot;
  } else {
    measurement.T_map_robot = placed.at.T_fixed_robot;
    measurement.T_odom_robot = placed.at.T_odom_robot;
  }
  return measurement;
}

ros::Subscriber hearCorrectedPath(ros::NodeHandle& node, ExternalCorrections& corrections) {
  const auto receive = [&corrections](const nav_msgs::Path::ConstPtr& path) {
    std::vector<ExternalCorrections::TimedPose> poses;
    for (const auto& stamped : path->poses) {
      poses.push_back({stamped.header.stamp.toSec(), flatPose(stamped.pose)});
    }
    corrections.correct(std::move(poses));
  };
  return node.subscribe<nav_msgs::Path>("corrected_path", 1, receive);
}

void logCorrection(const ExternalCorrections& corrections) {
  ROS_INFO("the localisation was corrected: the past is placed anew%s",
           corrections.isTold() ? " by corrected_path" : "");
}

std::string choosePose(ros::NodeHandle& node, const FrameNames& frames,
                       const std::function<void(const std::string&)>& tell) {
  const TransformFeed feed(node, [] {});
  const Transforms& tf = feed.transforms();
  ros::WallTime alone_since;
  while (keepRunning(0.1)) {
    const ros::WallTime now = ros::WallTime::now();
    if (tf.has(frames.map, frames.base, {})) {
      ROS_INFO("tf tells where the robot is: _pose:=tf");
      return "tf";
    }
    if (!tf.has(frames.odom, frames.base, {})) {
      alone_since = {};
      tell(tf.whyNot(frames.odom, frames.base));
      continue;
    }
    if (alone_since.isZero()) alone_since = now;
    if (now - alone_since > kPoseAwaited) {
      ROS_INFO("nobody tells where the robot is: _pose:=slam");
      return "slam";
    }
    tell("for somebody who tells where '" + frames.odom + "' is");
  }
  return {};
}

}  // namespace cca
