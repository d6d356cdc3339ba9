// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cca_mrpt/RoomAt.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <mutex>
#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"
#include "map_saver.hpp"

namespace cca {

/// The floor plan of the map as it grows: `plan` (latched markers), every few seconds where
/// somebody looks, and `~room_at`. It is made in a thread of its own of a copy of the map, so that
/// scans and robot do not wait for it.
class PlanServer {
 public:
  /// @param mutex     held while `snapshot` is called.
  /// @param snapshot  as of MapSaver.
  PlanServer(ros::NodeHandle& node, const ros::NodeHandle& private_node, std::string map_frame,
             std::mutex& mutex, MapSaver::Snapshot snapshot);

 private:
  void show();
  void makePlan();
  bool onRoomAt(cca_mrpt::RoomAt::Request& request, cca_mrpt::RoomAt::Response& response);

  std::string map_frame_;
  std::mutex& mutex_;
  MapSaver::Snapshot snapshot_;
  FloorPlan plan_;
  std::vector<Pose2> planned_;  ///< trajectory of the map that it is the plan of
  bool is_shown_ = true;        ///< there is nothing to show yet
  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::Publisher markers_;
  ros::ServiceServer service_;
  ros::WallTimer timer_;
  ros::AsyncSpinner spinner_;  // last: its thread ends before anything that it uses
};

}  // namespace cca
