// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/plan_markers.hpp"

#include <cstdio>
#include <string>
#include <utility>

namespace cca {
namespace {

using visualization_msgs::Marker;

constexpr double kOutlineWidth = 0.04, kOpeningWidth = 0.1;  // m
constexpr double kPlanHeight = 0.02, kLabelHeight = 0.1;     // m, above the grid
constexpr double kLetter = 0.4;                              // m

Marker planMarker(const std_msgs::Header& header, const char* name, int id, int type) {
  Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.color.a = 1.0f;
  marker.frame_locked = true;  // moves with the map frame when a pose correction moves that
  return marker;
}

geometry_msgs::Point planPoint(const Eigen::Vector2d& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = kPlanHeight;
  return point;
}

void addRing(const Polygon& ring, Marker& marker) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    marker.points.push_back(planPoint(ring[k]));
    marker.points.push_back(planPoint(ring[(k + 1) % ring.size()]));
  }
}

std::string labelOf(const PlanRoom& room) {
  char area[32];
  std::snprintf(area, sizeof area, "%.1f m2", room.area);
  return (room.name.empty() ? std::to_string(room.id) : room.name) + "\n" + area;
}

Marker labelMarker(const PlanRoom& room, const std_msgs::Header& header) {
  Marker label = planMarker(header, "room_labels", room.id, Marker::TEXT_VIEW_FACING);
  label.pose.position.x = room.label.x();
  label.pose.position.y = room.label.y();
  label.pose.position.z = kLabelHeight;
  label.scale.z = kLetter;
  label.text = labelOf(room);
  return label;
}

}  // namespace

visualization_msgs::MarkerArray planMarkers(const FloorPlan& plan, const std_msgs::Header& header) {
  visualization_msgs::MarkerArray array;
  array.markers.push_back(planMarker(header, "", 0, Marker::CUBE));
  array.markers.back().action = Marker::DELETEALL;
  Marker rooms = planMarker(header, "rooms", 0, Marker::LINE_LIST);
  rooms.scale.x = kOutlineWidth;
  rooms.color.g = 0.5f;
  rooms.color.b = 0.35f;
  for (const PlanRoom& room : plan.rooms) {
    addRing(room.outline, rooms);
    for (const Polygon& hole : room.holes) addRing(hole, rooms);
  }
  Marker openings = planMarker(header, "openings", 0, Marker::LINE_LIST);
  openings.scale.x = kOpeningWidth;
  openings.color.r = 0.8f;
  openings.color.g = 0.3f;
  for (const PlanOpening& opening : plan.openings) {
    openings.points.push_back(planPoint(opening.a));
    openings.points.push_back(planPoint(opening.b));
  }
  // rviz complains of a list without points.
  if (!rooms.points.empty()) array.markers.push_back(std::move(rooms));
  if (!openings.points.empty()) array.markers.push_back(std::move(openings));
  for (const PlanRoom& room : plan.rooms) array.markers.push_back(labelMarker(room, header));
  return array;
}

}  // namespace cca
