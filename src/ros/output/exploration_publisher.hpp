// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <nav_msgs/GetMap.h>
#include <ros/ros.h>

#include <string>

#include "cca_mrpt/session/exploration_session.hpp"
#include "line_publisher.hpp"
#include "way_publisher.hpp"

namespace cca {

/// What an exploration shows of itself: `lines`, `line_markers`, `map`, `frontier_markers`, `goal`,
/// `robot_markers`, `trajectory` and `status`. All but `goal` are latched, so late subscribers see
/// the whole. `static_map` and `dynamic_map` answer with the last `map`.
class ExplorationPublisher {
 public:
  /// @param radius  m, of the robot.
  ExplorationPublisher(ros::NodeHandle& node, std::string map_frame, double radius);

  /// After each step. Lines go out at most 25 times, grid, frontiers and way once a second of the
  /// wall; a changed goal at once.
  void show(const ExplorationSession& session, const mrpt::maps::COccupancyGridMap2D& grid,
            const Pose2& T_map_robot, const std::optional<Pose2>& T_map_goal,
            const ros::Time& stamp);
  /// All of it now, as it stands.
  void showAll(const ExplorationSession& session, const mrpt::maps::COccupancyGridMap2D& grid,
               const ros::Time& stamp);
  /// This is the way so far: the past has been corrected.
  void correctWay(const MappingSession& mapping) {
    way_.replace(mapping.times(), mapping.trajectory());
  }
  /// Where it differs from what stands. The first word is the state.
  void showStatus(const std::string& status);
  const std::string& status() const { return shown_status_; }

 private:
  void showGoal(const std::optional<Pose2>& T_map_goal, const ros::Time& stamp);
  bool onGetMap(nav_msgs::GetMap::Request&, nav_msgs::GetMap::Response& response);

  std::string map_frame_;
  double radius_;  // m
  LinePublisher lines_;
  WayPublisher way_;
  ros::Publisher map_, map_metadata_, frontiers_, robot_, goal_, status_;
  ros::ServiceServer static_map_, dynamic_map_;
  ros::WallTime lines_shown_, map_shown_;
  nav_msgs::OccupancyGrid shown_map_;
  std::optional<Eigen::Vector2d> shown_goal_;
  std::string shown_status_;
};

}  // namespace cca
