// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cca_mrpt/DriveToRoom.h>
#include <cca_mrpt/RoomAt.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"
#include "io/plans/plan_formats.hpp"
#include "map_saver.hpp"

namespace cca {

/// The floor plan of the map as it grows: `plan` (latched markers), every few seconds where
/// somebody looks, `~room_at` and `~drive_to_room`. It is made in a thread of its own of a copy of
/// the map, so that scans and robot do not wait for it.
///
/// Goals go to `move_base_simple/goal`: whoever drives the robot takes them from there.
class PlanServer {
 public:
  /// @param labels  CSV with names of rooms, in the map frame; empty: none.
  /// @param saver   of the same map; outlives this.
  PlanServer(ros::NodeHandle& node, const ros::NodeHandle& private_node, std::string map_frame,
             const std::string& labels, MapSaver& saver);

 private:
  void show();
  void makePlan();
  /// @return  false: there is none, and why.
  bool tryPlan(std::string& why_not);
  bool onRoomAt(cca_mrpt::RoomAt::Request& request, cca_mrpt::RoomAt::Response& response);
  bool onDriveToRoom(cca_mrpt::DriveToRoom::Request& request,
                     cca_mrpt::DriveToRoom::Response& response);
  void sendTo(const PlanRoom& room, cca_mrpt::DriveToRoom::Response& response);

  std::string map_frame_;
  RoomLabels labels_;
  MapSaver& saver_;
  FloorPlan plan_;
  std::vector<Pose2> planned_;  ///< trajectory of the map that it is the plan of
  bool is_shown_ = true;        ///< there is nothing to show yet
  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::Publisher markers_, goals_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
  ros::AsyncSpinner spinner_;  // last: its thread ends before anything that it uses
};

}  // namespace cca
