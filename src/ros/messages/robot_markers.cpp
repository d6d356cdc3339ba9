// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/robot_markers.hpp"

#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

constexpr double kBodyHeight = 0.1, kArrowHeight = 0.12;  // m; above lines and grid
constexpr double kArrow = 1.6;                            // of the radius: it sticks out ahead
constexpr double kTextHeight = 0.45;                      // m, of a capital A

visualization_msgs::Marker robotMarker(const std_msgs::Header& header, int id, int type,
                                       const Pose2& T_map_marker, double z) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = "robot";
  marker.id = id;
  marker.type = type;
  marker.pose = poseMessage(T_map_marker);
  marker.pose.position.z = z;
  marker.color.a = 1.0f;
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray robotMarkers(const Pose2& T_map_robot, double radius,
                                             const std::string& words,
                                             const std_msgs::Header& header) {
  using visualization_msgs::Marker;
  Marker body = robotMarker(header, 0, Marker::CYLINDER, T_map_robot, 0.5 * kBodyHeight);
  body.scale.x = body.scale.y = 2.0 * radius;
  body.scale.z = kBodyHeight;
  body.color.g = 0.45f;
  body.color.b = 0.55f;
  Marker ahead = robotMarker(header, 1, Marker::ARROW, T_map_robot, kArrowHeight);
  ahead.scale.x = kArrow * radius;
  ahead.scale.y = ahead.scale.z = 0.4 * radius;
  ahead.color.r = ahead.color.g = 1.0f;
  const Pose2 below{T_map_robot.x, T_map_robot.y - radius - kTextHeight, 0.0};
  Marker text = robotMarker(header, 2, Marker::TEXT_VIEW_FACING, below, kArrowHeight);
  text.scale.z = kTextHeight;
  text.text = words;
  visualization_msgs::MarkerArray array;
  array.markers = {body, ahead, text};
  return array;
}

}  // namespace cca
