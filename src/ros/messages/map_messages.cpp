// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/map_messages.hpp"

#include <utility>

#include "io/files/text.hpp"
#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kLineWidth = 0.06;  // m; a wall as one sees it in a map of a whole floor
constexpr double kHeight = 0.02, kFrontierHeight = 0.01;     // m; above the grid, so not hidden
constexpr double kOutlineWidth = 0.04, kOpeningWidth = 0.1;  // m
constexpr double kLabelHeight = 0.1;                         // m, above the grid
constexpr double kLetter = 0.4;                              // m
constexpr double kBodyHeight = 0.1, kArrowHeight = 0.12;     // m; above lines and grid
constexpr double kArrow = 1.6;                               // of the radius: it sticks out ahead
constexpr double kTextHeight = 0.45;                         // m, of a capital A

geometry_msgs::Point pointMessage(const Eigen::Vector2d& p, double z = kHeight) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = z;
  return message;
}

std_msgs::ColorRGBA color(float r, float g, float b, float a = 1.0f) {
  std_msgs::ColorRGBA c;
  c.r = r, c.g = g, c.b = b, c.a = a;
  return c;
}

Marker markerOf(const std_msgs::Header& header, const std::string& name, int type,
                const std_msgs::ColorRGBA& colour = color(0, 0, 0)) {
  Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.color = colour;
  marker.frame_locked = true;  // moves with the map frame when a pose correction moves that
  return marker;
}

/// rviz complains of a list without points: such a marker goes.
MarkerArray asArray(Marker marker) {
  marker.action = marker.points.empty() ? Marker::DELETE : Marker::ADD;
  MarkerArray array;
  array.markers.push_back(std::move(marker));
  return array;
}

void addRing(const Polygon& ring, Marker& marker) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    marker.points.push_back(pointMessage(ring[k]));
    marker.points.push_back(pointMessage(ring[(k + 1) % ring.size()]));
  }
}

Marker labelMarker(const PlanRoom& room, const std_msgs::Header& header) {
  Marker label = markerOf(header, "room_labels", Marker::TEXT_VIEW_FACING);
  label.id = room.id;
  label.pose.position = pointMessage(room.label, kLabelHeight);
  label.scale.z = kLetter;
  label.text =
      (room.name.empty() ? std::to_string(room.id) : room.name) + formatted("\n%.1f m2", room.area);
  return label;
}

Marker robotMarker(const std_msgs::Header& header, int id, int type, const Pose2& T_map_marker,
                   double z) {
  Marker marker = markerOf(header, "robot", type);
  marker.frame_locked = false;  // it is where it was at its stamp
  marker.id = id;
  marker.pose = poseMessage(T_map_marker);
  marker.pose.position.z = z;
  return marker;
}

}  // namespace

cca_mrpt::LineMap lineMapMessage(const std::vector<MapLine>& lines,
                                 const std_msgs::Header& header) {
  cca_mrpt::LineMap message;
  message.header = header;
  message.lines.reserve(lines.size());
  for (const auto& line : lines) {
    cca_mrpt::LineSegment segment;
    segment.id = line.id;
    segment.start = pointMessage(line.segment.start, 0.0);
    segment.end = pointMessage(line.segment.end, 0.0);
    const auto& covariance = line.segment.covariance;
    segment.covariance = {covariance(0, 0), covariance(0, 1), covariance(1, 0), covariance(1, 1)};
    segment.support = line.support;
    message.lines.push_back(segment);
  }
  return message;
}

MarkerArray lineMarkers(const std::vector<MapLine>& lines, const std_msgs::Header& header) {
  auto marker = markerOf(header, "lines", Marker::LINE_LIST, color(0.05f, 0.25f, 0.75f));
  marker.scale.x = kLineWidth;
  marker.points.reserve(2 * lines.size());
  for (const auto& line : lines) {
    marker.points.push_back(pointMessage(line.segment.start));
    marker.points.push_back(pointMessage(line.segment.end));
  }
  return asArray(std::move(marker));
}

MarkerArray frontierMarkers(const std::vector<Eigen::Vector2d>& cells_map, double cell_size,
                            const std_msgs::Header& header) {
  auto marker = markerOf(header, "frontiers", Marker::CUBE_LIST, color(0.95f, 0.55f, 0.1f, 0.9f));
  marker.scale.x = marker.scale.y = cell_size;
  marker.scale.z = kFrontierHeight;
  marker.points.reserve(cells_map.size());
  for (const auto& cell : cells_map) marker.points.push_back(pointMessage(cell, kFrontierHeight));
  return asArray(std::move(marker));
}

MarkerArray loopMarkers(const std::vector<Eigen::Vector2d>& ends_map,
                        const std_msgs::Header& header) {
  auto marker = markerOf(header, "loops", Marker::LINE_LIST, color(0.85f, 0.15f, 0.55f));
  marker.scale.x = 0.5 * kLineWidth;
  for (const auto& end : ends_map) marker.points.push_back(pointMessage(end));
  return asArray(std::move(marker));
}

MarkerArray planMarkers(const FloorPlan& plan, const std_msgs::Header& header) {
  MarkerArray array;
  array.markers.push_back(markerOf(header, "", Marker::CUBE));
  array.markers.back().action = Marker::DELETEALL;
  Marker rooms = markerOf(header, "rooms", Marker::LINE_LIST, color(0.0f, 0.5f, 0.35f));
  rooms.scale.x = kOutlineWidth;
  for (const PlanRoom& room : plan.rooms) {
    addRing(room.outline, rooms);
    for (const Polygon& hole : room.holes) addRing(hole, rooms);
  }
  Marker openings = markerOf(header, "openings", Marker::LINE_LIST, color(0.8f, 0.3f, 0.0f));
  openings.scale.x = kOpeningWidth;
  for (const PlanOpening& opening : plan.openings) {
    openings.points.push_back(pointMessage(opening.a));
    openings.points.push_back(pointMessage(opening.b));
  }
  // rviz complains of a list without points.
  if (!rooms.points.empty()) array.markers.push_back(std::move(rooms));
  if (!openings.points.empty()) array.markers.push_back(std::move(openings));
  for (const PlanRoom& room : plan.rooms) array.markers.push_back(labelMarker(room, header));
  return array;
}

MarkerArray robotMarkers(const Pose2& T_map_robot, double radius, const std::string& words,
                         const std_msgs::Header& header) {
  Marker body = robotMarker(header, 0, Marker::CYLINDER, T_map_robot, 0.5 * kBodyHeight);
  body.scale.x = body.scale.y = 2.0 * radius;
  body.scale.z = kBodyHeight;
  body.color = color(0.0f, 0.45f, 0.55f);
  Marker ahead = robotMarker(header, 1, Marker::ARROW, T_map_robot, kArrowHeight);
  ahead.scale.x = kArrow * radius;
  ahead.scale.y = ahead.scale.z = 0.4 * radius;
  ahead.color = color(1.0f, 1.0f, 0.0f);
  const Pose2 below{T_map_robot.x, T_map_robot.y - radius - kTextHeight, 0.0};
  Marker text = robotMarker(header, 2, Marker::TEXT_VIEW_FACING, below, kArrowHeight);
  text.scale.z = kTextHeight;
  text.text = words;
  MarkerArray array;
  array.markers = {body, ahead, text};
  return array;
}

}  // namespace cca
