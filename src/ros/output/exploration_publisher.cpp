// SPDX-License-Identifier: BSD-3-Clause
#include "exploration_publisher.hpp"
#include "cca_mrpt/navigation/world/exploration_grid.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>
#include <std_msgs/String.h>

#include "navigation/world/world_model.hpp"
#include "ros/messages/grid_message.hpp"
#include "ros/messages/map_messages.hpp"
#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

const ros::WallDuration kLinePeriod(0.04), kMapPeriod(1.0);

}  // namespace

ExplorationPublisher::ExplorationPublisher(ros::NodeHandle& node, std::string map_frame,
                                           double radius)
    : map_frame_(std::move(map_frame)),
      radius_(radius),
      lines_(node, map_frame_),
      way_(node, map_frame_),
      map_(node.advertise<nav_msgs::OccupancyGrid>("map", 1, true)),
      map_metadata_(node.advertise<nav_msgs::MapMetaData>("map_metadata", 1, true)),
      frontiers_(node.advertise<visualization_msgs::MarkerArray>("frontier_markers", 1, true)),
      robot_(node.advertise<visualization_msgs::MarkerArray>("robot_markers", 1, true)),
      goal_(node.advertise<geometry_msgs::PoseStamped>("goal", 5)),
      status_(node.advertise<std_msgs::String>("status", 5, true)),
      static_map_(node.advertiseService("static_map", &ExplorationPublisher::onGetMap, this)),
      dynamic_map_(node.advertiseService("dynamic_map", &ExplorationPublisher::onGetMap, this)) {}

void ExplorationPublisher::showGoal(const std::optional<Pose2>& T_map_goal,
                                    const ros::Time& stamp) {
  const auto is_shown = [&](const Pose2& T) { return shown_goal_ && *shown_goal_ == T.position(); };
  if (T_map_goal && !is_shown(*T_map_goal)) {
    goal_.publish(poseMessage(*T_map_goal, map_frame_, stamp));
  }
  shown_goal_.reset();
  if (T_map_goal) shown_goal_ = T_map_goal->position();
}

void ExplorationPublisher::show(const ExplorationSession& session,
                                const mrpt::maps::COccupancyGridMap2D& grid,
                                const Pose2& T_map_robot, const std::optional<Pose2>& T_map_goal,
                                const ros::Time& stamp) {
  way_.add(T_map_robot, stamp);
  showGoal(T_map_goal, stamp);
  if (robot_.getNumSubscribers() > 0) {
    robot_.publish(
        robotMarkers(T_map_robot, radius_, shown_status_, headerMessage(map_frame_, stamp)));
  }
  const ros::WallTime now = ros::WallTime::now();
  if (now - map_shown_ >= kMapPeriod) {
    showAll(session, grid, stamp);
  } else if (now - lines_shown_ >= kLinePeriod) {
    lines_.publish(session.mapping().lineMap().lines(), stamp);
    lines_shown_ = now;
  }
}

void ExplorationPublisher::showAll(const ExplorationSession& session,
                                   const mrpt::maps::COccupancyGridMap2D& grid,
                                   const ros::Time& stamp) {
  lines_.publish(session.mapping().lineMap().lines(), stamp);
  const std_msgs::Header header = headerMessage(map_frame_, stamp);
  shown_map_ = gridMessage(grid, header);
  map_.publish(shown_map_);
  map_metadata_.publish(shown_map_.info);
  std::vector<Eigen::Vector2d> frontier;
  const Explorer& explorer = session.explorer();
  const auto& exploration_grid = explorer.grid();
  for (const Cell cell : explorer.world().frontierCells().cells()) {
    frontier.push_back(exploration_grid.centreOf(cell));
  }
  frontiers_.publish(frontierMarkers(frontier, exploration_grid.resolution(), header));
  way_.publish(stamp);
  lines_shown_ = map_shown_ = ros::WallTime::now();
}

bool ExplorationPublisher::onGetMap(nav_msgs::GetMap::Request& /*request*/,
                                    nav_msgs::GetMap::Response& response) {
  response.map = shown_map_;
  return !shown_map_.data.empty();  // else who asks is told that it failed, and asks again
}

void ExplorationPublisher::showStatus(const std::string& status) {
  if (status == shown_status_) return;
  shown_status_ = status;
  std_msgs::String message;
  message.data = status;
  status_.publish(message);
  ROS_INFO("%s", status.c_str());
}

}  // namespace cca
