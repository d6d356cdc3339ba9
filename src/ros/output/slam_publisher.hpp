// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include "cca_mrpt/slam/slam_localiser.hpp"
#include "pose_publisher.hpp"
#include "ros/input/transforms.hpp"
#include "ros/nodes/node_diagnostics.hpp"

namespace cca {

/// Publishes what line SLAM believes, as REP 105 has it: map -> odom on tf, `pose`, and
/// `loop_markers`.
class SlamPublisher {
 public:
  SlamPublisher(ros::NodeHandle& node, const FrameNames& frames);

  /// After each scan. @param T_odom_robot  at its time. @param diagnostics  told of it, too.
  void publish(const Estimate& estimate, const Pose2& T_odom_robot, const SlamLocaliser& localiser,
               const ros::Time& stamp, NodeDiagnostics& diagnostics);

 private:
  void publishLoops(const Slam& slam, const ros::Time& stamp);

  std::string map_frame_;
  PosePublisher pose_;
  std::size_t loops_shown_ = 0;
  ros::Publisher loop_markers_;
};

}  // namespace cca
