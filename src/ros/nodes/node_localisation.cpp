// SPDX-License-Identifier: BSD-3-Clause
#include "node_localisation.hpp"

#include <cmath>
#include <utility>

#include "cca_mrpt/localisation/given_poses.hpp"
#include "node_main.hpp"
#include "ros/input/transform_feed.hpp"

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
  measurement.T_robot_sensor = placed.T_robot_sensor;
  measurement.time = placed.middle.toSec();
  measurement.motion = placed.motion;
  if (is_in_odometry) {
    measurement.T_odom_robot = placed.T_fixed_robot;
  } else {
    measurement.T_map_robot = placed.T_fixed_robot;
    measurement.T_odom_robot = placed.T_odom_robot;
  }
  return measurement;
}

CorrectedPath::CorrectedPath(ros::NodeHandle& node, ExternalCorrections& corrections)
    : corrections_(corrections),
      path_(node.subscribe("corrected_path", 1, &CorrectedPath::receive, this)) {}

void CorrectedPath::logCorrection() const {
  ROS_INFO("the localisation was corrected: the past is placed anew%s",
           corrections_.isTold() ? " by corrected_path" : "");
}

void CorrectedPath::receive(const nav_msgs::Path& path) {
  std::vector<ExternalCorrections::TimedPose> poses;
  for (const auto& stamped : path.poses) {
    const auto& p = stamped.pose.position;
    const auto& q = stamped.pose.orientation;
    poses.push_back({stamped.header.stamp.toSec(), {p.x, p.y, 2.0 * std::atan2(q.z, q.w)}});
  }
  corrections_.correct(std::move(poses));
}

std::string choosePose(ros::NodeHandle& node, const FrameNames& frames,
                       const std::function<void(const std::string&)>& tell) {
  const TransformFeed feed(node, [] {});
  const Transforms& tf = feed.transforms();
  ros::WallTime alone_since;
  while (keepRunning(0.1)) {
    const ros::WallTime now = ros::WallTime::now();
    if (tf.has(frames.map, frames.base, {})) return "tf";
    if (!tf.has(frames.odom, frames.base, {})) {
      alone_since = {};
      tell(tf.whyNot(frames.odom, frames.base));
      continue;
    }
    if (alone_since.isZero()) alone_since = now;
    if (now - alone_since > kPoseAwaited) return "slam";
    tell("for somebody who tells where '" + frames.odom + "' is");
  }
  return {};
}

}  // namespace cca
