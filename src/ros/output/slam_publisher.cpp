// SPDX-License-Identifier: BSD-3-Clause
#include "slam_publisher.hpp"

#include "ros/messages/map_messages.hpp"
#include "ros/messages/pose_message.hpp"
#include "slam/loop_closing.hpp"

namespace cca {

SlamPublisher::SlamPublisher(ros::NodeHandle& node, const FrameNames& frames)
    : map_frame_(frames.map),
      pose_(node, frames, "pose"),
      loop_markers_(node.advertise<visualization_msgs::MarkerArray>("loop_markers", 1, true)) {}

void SlamPublisher::publish(const Estimate& estimate, const Pose2& T_odom_robot,
                            const SlamLocaliser& localiser, const ros::Time& stamp,
                            NodeDiagnostics& diagnostics) {
  pose_.publish(estimate, T_odom_robot, stamp);
  const Slam& slam = localiser.slam();
  if (estimate.was_corrected || slam.loopsClosed() != loops_shown_) publishLoops(slam, stamp);
  diagnostics.note("slam: agreement of the last scan", estimate.agreement);
  diagnostics.note("slam: loops closed", slam.loopsClosed());
  diagnostics.note("slam: lost", !estimate.is_known);
  diagnostics.note("slam: found in the earlier map", slam.remembered() > 0 && slam.isInMemory());
  diagnostics.note("slam: corrections of the past", localiser.corrections());
}

void SlamPublisher::publishLoops(const Slam& slam, const ros::Time& stamp) {
  const PoseGraph& graph = slam.graph();
  std::vector<Eigen::Vector2d> ends;
  for (const LoopVerdict& loop : slam.loops()) {
    ends.push_back(graph.pose(loop.frame).position());
    ends.push_back(graph.pose(loop.candidate).position());
  }
  loop_markers_.publish(loopMarkers(ends, headerMessage(map_frame_, stamp)));
  loops_shown_ = slam.loopsClosed();
}

}  // namespace cca
