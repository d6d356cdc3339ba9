// SPDX-License-Identifier: BSD-3-Clause
#include "plan_server.hpp"

#include <geometry_msgs/PoseStamped.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "io/files/text.hpp"
#include "io/maps/occupancy_files.hpp"
#include "io/plans/plan_files.hpp"
#include "ros/messages/map_messages.hpp"
#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

const ros::WallDuration kPlanPeriod(5.0);

std::string inWords(const PlanRoom& room) {
  return (room.name.empty() ? "" : room.name + ": ") +
         formatted("room %d, %.1f m2%s", room.id, room.area,
                   room.open_border > 0.5 ? ", not yet seen to its end" : "");
}

/// The room of a name, else of an id; nullptr: none.
const PlanRoom* roomCalled(const std::string& name, const std::vector<PlanRoom>& rooms) {
  for (const bool by_name : {true, false}) {
    for (const PlanRoom& room : rooms) {
      if (!name.empty() && name == (by_name ? room.name : std::to_string(room.id))) return &room;
    }
  }
  return nullptr;
}

std::string callNames(const std::vector<PlanRoom>& rooms) {
  std::string names;
  for (const PlanRoom& room : rooms)
    names += (names.empty() ? "" : ", ") +
             (room.name.empty() ? std::to_string(room.id) : "'" + room.name + "'");
  return names.empty() ? "there are no rooms yet" : "there are " + names;
}

}  // namespace

PlanServer::PlanServer(ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       std::string map_frame, const std::string& labels, MapSaver& saver)
    : map_frame_(std::move(map_frame)),
      labels_(labels.empty() ? RoomLabels{} : roomLabelsOfFile(labels)),
      saver_(saver),
      node_(private_node),
      markers_(node.advertise<visualization_msgs::MarkerArray>("plan", 1, true)),
      goals_(node.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1)),
      spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  services_ = {node_.advertiseService("room_at", &PlanServer::onRoomAt, this),
               node_.advertiseService("drive_to_room", &PlanServer::onDriveToRoom, this)};
  const auto callback = [this](const ros::WallTimerEvent&) { show(); };
  timer_ = node_.createWallTimer(kPlanPeriod, callback);
  spinner_.start();
}

void PlanServer::makePlan() {
  const MapProducts map = saver_.products();
  // Where nothing was seen since, and the past was not corrected, it is the same map.
  const auto is_same = [](const Pose2& a, const Pose2& b) {
    return a.x == b.x && a.y == b.y && a.theta == b.theta;
  };
  if (!map.grid || std::equal(map.trajectory.begin(), map.trajectory.end(), planned_.begin(),
                              planned_.end(), is_same))
    return;
  plan_ = planOfMap(seenFrom(-map.origin, map).lines, asWritten(*map.grid, map.origin));
  nameRooms(plan_, labels_);
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
  markers_.publish(planMarkers(plan_, headerMessage(map_frame_, ros::Time::now())));
  is_shown_ = true;
}

bool PlanServer::tryPlan(std::string& why_not) try {
  makePlan();
  return true;
} catch (const std::exception& error) {
  why_not = error.what();
  return false;
}

bool PlanServer::onRoomAt(cca_mrpt::RoomAt::Request& request,
                          cca_mrpt::RoomAt::Response& response) {
  response.success = false;
  if (!tryPlan(response.message)) return true;
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

bool PlanServer::onDriveToRoom(cca_mrpt::DriveToRoom::Request& request,
                               cca_mrpt::DriveToRoom::Response& response) {
  response.success = false;
  if (!tryPlan(response.message)) return true;
  if (const PlanRoom* room = roomCalled(request.room, plan_.rooms)) {
    sendTo(*room, response);
  } else {
    response.message = "no room is called '" + request.room + "'; " + callNames(plan_.rooms);
  }
  return true;
}

void PlanServer::sendTo(const PlanRoom& room, cca_mrpt::DriveToRoom::Response& response) {
  const Eigen::Vector2d here =
      planned_.empty() ? Eigen::Vector2d(room.label) : planned_.back().position();
  const Eigen::Vector2d way = room.label - here;
  const double heading = way.isZero() ? 0.0 : std::atan2(way.y(), way.x());  // as it drives in
  response.goal =
      poseMessage({room.label.x(), room.label.y(), heading}, map_frame_, ros::Time::now());
  response.id = static_cast<std::uint32_t>(room.id);
  response.message = inWords(room);
  response.success = goals_.getNumSubscribers() > 0;
  if (response.success)
    goals_.publish(response.goal);
  else
    response.message = "nobody listens to " + goals_.getTopic();
}

}  // namespace cca
