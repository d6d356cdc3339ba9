// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <ros/ros.h>

#include <string>

#include "cca_mrpt/session/exploration_session.hpp"
#include "line_publisher.hpp"
#include "way_publisher.hpp"

namespace cca {

/// What an exploration shows of itself: `lines`, `line_markers`, `map`, `frontier_markers`, `goal`,
/// `trajectory` and `status`. All but `goal` are latched, so late subscribers see the whole.
class ExplorationPublisher {
 public:
  ExplorationPublisher(ros::NodeHandle& node, std::string map_frame);

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

 private:
  void showGoal(const std::optional<Pose2>& T_map_goal, const ros::Time& stamp);
  std_msgs::Header header(const ros::Time& stamp) const;

  std::string map_frame_;
  LinePublisher lines_;
  WayPublisher way_;
  ros::Publisher map_, map_metadata_, frontiers_, goal_, status_;
  ros::WallTime lines_shown_, map_shown_;
  std::optional<Eigen::Vector2d> shown_goal_;
  std::string shown_status_;
};

}  // namespace cca
