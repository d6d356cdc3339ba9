// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/line_messages.hpp"

namespace cca {
namespace {

constexpr double kLineWidth = 0.06;  // m; a wall as one sees it in a map of a whole floor
constexpr double kLineHeight = 0.02, kFrontierHeight = 0.01;  // m; above the grid, so not hidden

geometry_msgs::Point pointMessage(const Eigen::Vector2d& p, double z = 0.0) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = z;
  return message;
}

std_msgs::ColorRGBA color(float r, float g, float b, float a) {
  std_msgs::ColorRGBA c;
  c.r = r, c.g = g, c.b = b, c.a = a;
  return c;
}

visualization_msgs::Marker emptyMarker(const std_msgs::Header& header, const char* ns, int type) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = ns;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.frame_locked = true;  // moves with the map frame when a pose correction moves that
  return marker;
}

/// rviz complains of a list without points: such a marker goes.
visualization_msgs::MarkerArray asArray(visualization_msgs::Marker marker) {
  using visualization_msgs::Marker;
  marker.action = marker.points.empty() ? Marker::DELETE : Marker::ADD;
  visualization_msgs::MarkerArray array;
  array.markers.push_back(std::move(marker));
  return array;
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
    segment.start = pointMessage(line.segment.start);
    segment.end = pointMessage(line.segment.end);
    const auto& covariance = line.segment.covariance;
    segment.covariance = {covariance(0, 0), covariance(0, 1), covariance(1, 0), covariance(1, 1)};
    segment.support = line.support;
    message.lines.push_back(segment);
  }
  return message;
}

visualization_msgs::MarkerArray lineMarkers(const std::vector<MapLine>& lines,
                                            const std_msgs::Header& header) {
  auto marker = emptyMarker(header, "lines", visualization_msgs::Marker::LINE_LIST);
  marker.scale.x = kLineWidth;
  marker.color = color(0.05f, 0.25f, 0.75f, 1.0f);
  marker.points.reserve(2 * lines.size());
  for (const auto& line : lines) {
    marker.points.push_back(pointMessage(line.segment.start, kLineHeight));
    marker.points.push_back(pointMessage(line.segment.end, kLineHeight));
  }
  return asArray(std::move(marker));
}

visualization_msgs::MarkerArray frontierMarkers(const std::vector<Eigen::Vector2d>& cells_map,
                                                double cell_size, const std_msgs::Header& header) {
  auto marker = emptyMarker(header, "frontiers", visualization_msgs::Marker::CUBE_LIST);
  marker.scale.x = marker.scale.y = cell_size;
  marker.scale.z = kFrontierHeight;
  marker.color = color(0.95f, 0.55f, 0.1f, 0.9f);
  marker.points.reserve(cells_map.size());
  for (const auto& cell : cells_map) marker.points.push_back(pointMessage(cell, kFrontierHeight));
  return asArray(std::move(marker));
}

visualization_msgs::MarkerArray loopMarkers(const std::vector<Eigen::Vector2d>& ends_map,
                                            const std_msgs::Header& header) {
  auto marker = emptyMarker(header, "loops", visualization_msgs::Marker::LINE_LIST);
  marker.scale.x = 0.5 * kLineWidth;
  marker.color = color(0.85f, 0.15f, 0.55f, 1.0f);
  for (const auto& end : ends_map) marker.points.push_back(pointMessage(end, kLineHeight));
  return asArray(std::move(marker));
}

}  // namespace cca
