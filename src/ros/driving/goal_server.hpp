// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Path.h>

#include <optional>
#include <string>
#include <vector>

#include "ros/input/transform_feed.hpp"
#include "ros/nodes/exploration.hpp"

namespace cca {

/// Sends the robot where others want it: by the action `~goal` (move_base_msgs/MoveBase) and by
/// `move_base_simple/goal`, as move_base does. The latest goal counts. In any frame that tf joins
/// with the map's, as it stands when the goal comes.
///
/// By `patrol` (nav_msgs/Path) it is sent from place to place, over and over, until something else
/// calls it off or an empty path comes. A place that it cannot reach is passed over; a round in
/// which it reaches none is the last. Lives in the thread that spins.
class GoalServer {
 public:
  /// @param exploration  must outlive this.
  GoalServer(ros::NodeHandle& node, ros::NodeHandle& private_node, std::string map_frame,
             Exploration& exploration);

 private:
  /// @return  why the goal is refused; empty where it is not.
  std::string send(const geometry_msgs::PoseStamped& goal, Exploration::ErrandEnd end);
  void takeOfAction();
  void takeOfTopic(const geometry_msgs::PoseStamped& goal);
  void takePatrol(const nav_msgs::Path& path);
  void goOnPatrol();
  void endAction(Exploration::ErrandOutcome outcome, const std::string& how);
  void tellProgress();
  /// T_map_goal. @throws std::runtime_error where that is not known, or the pose is none.
  Pose2 inMap(const geometry_msgs::PoseStamped& goal) const;

  std::string map_frame_;
  Exploration& exploration_;
  TransformFeed transforms_;
  actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> action_;
  struct Patrol {
    std::vector<Pose2> places;  ///< T_map_goal
    std::size_t next = 0;
    std::size_t missed = 0;  ///< in a row
    bool is_due = true;      ///< the next place is
  };
  std::optional<Patrol> patrol_;
  ros::Subscriber simple_, path_;
  ros::WallTimer progress_;
};

}  // namespace cca
