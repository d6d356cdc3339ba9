// SPDX-License-Identifier: BSD-3-Clause
#include "plan_server.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <utility>

#include "io/maps/occupancy_files.hpp"
#include "io/plans/plan_files.hpp"
#include "ros/messages/plan_markers.hpp"

namespace cca {
namespace {

const ros::WallDuration kPlanPeriod(5.0);

std::string inWords(const PlanRoom& room) {
  char text[96];
  std::snprintf(text, sizeof text, "room %d, %.1f m2%s", room.id, room.area,
                room.open_border > 0.5 ? ", not yet seen to its end" : "");
  return text;
}

}  // namespace

PlanServer::PlanServer(ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       std::string map_frame, std::mutex& mutex, MapSaver::Snapshot snapshot)
    : map_frame_(std::move(map_frame)),
      mutex_(mutex),
      snapshot_(std::move(snapshot)),
      node_(private_node),
      markers_(node.advertise<visualization_msgs::MarkerArray>("plan", 1, true)),
      spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  service_ = node_.advertiseService("room_at", &PlanServer::onRoomAt, this);
  const auto callback = [this](const ros::WallTimerEvent&) { show(); };
  timer_ = node_.createWallTimer(kPlanPeriod, callback);
  spinner_.start();
}

void PlanServer::makePlan() {
  const MapProducts map = [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return snapshot_();
  }();
  // Where nothing was seen since, and the past was not corrected, it is the same map.
  const auto is_same = [](const Pose2& a, const Pose2& b) {
    return a.x == b.x && a.y == b.y && a.theta == b.theta;
  };
  if (!map.grid || std::equal(map.trajectory.begin(), map.trajectory.end(), planned_.begin(),
                              planned_.end(), is_same))
    return;
  plan_ = planOfMap(seenFrom(-map.origin, map).lines, asWritten(*map.grid, map.origin));
  planned_ = map.trajectory;
  is_shown_ = false;
}

void PlanServer::show() {
  try {
    if (markers_.getNumSubscribers() > 0) makePlan();
  } catch (const std::exception&) {  // there is no map, or no longer
    is_shown_ = plan_.rooms.empty();
    plan_ = {};
    planned_.clear();
  }
  if (is_shown_) return;
  std_msgs::Header header;
  header.frame_id = map_frame_;
  header.stamp = ros::Time::now();
  markers_.publish(planMarkers(plan_, header));
  is_shown_ = true;
}

bool PlanServer::onRoomAt(cca_mrpt::RoomAt::Request& request,
                          cca_mrpt::RoomAt::Response& response) {
  response.success = false;
  try {
    makePlan();
  } catch (const std::exception& error) {
    response.message = error.what();
    return true;
  }
  const int id = roomAt(plan_, {request.point.x, request.point.y});
  const auto room = std::find_if(plan_.rooms.begin(), plan_.rooms.end(),
                                 [id](const PlanRoom& one) { return one.id == id; });
  if (room == plan_.rooms.end()) {
    response.message = "in no room";
    return true;
  }
  response.success = true;
  response.message = inWords(*room);
  response.id = static_cast<std::uint32_t>(room->id);
  response.area = room->area;
  response.unseen_area = room->unseen_area;
  response.open_border = room->open_border;
  response.label.x = room->label.x();
  response.label.y = room->label.y();
  return true;
}

}  // namespace cca
