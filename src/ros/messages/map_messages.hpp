// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cca_mrpt/LineMap.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"
#include "cca_mrpt/geometry/pose2.hpp"
#include "cca_mrpt/mapping/line_map.hpp"

namespace cca {

/// The map's lines, in the order given. The header's frame is that of the lines.
cca_mrpt::LineMap lineMapMessage(const std::vector<MapLine>& lines, const std_msgs::Header& header);

/// The same lines to look at: one LINE_LIST marker, two points a line, in the same order. Without
/// lines: a marker that deletes the earlier ones.
visualization_msgs::MarkerArray lineMarkers(const std::vector<MapLine>& lines,
                                            const std_msgs::Header& header);

/// Cells at the edge of the known, as small squares (one CUBE_LIST marker).
/// @param cell_size  m.
visualization_msgs::MarkerArray frontierMarkers(const std::vector<Eigen::Vector2d>& cells_map,
                                                double cell_size, const std_msgs::Header& header);

/// Loops that a SLAM has closed, from each later visit to the earlier one (one LINE_LIST).
/// @param ends_map  m, two a loop.
visualization_msgs::MarkerArray loopMarkers(const std::vector<Eigen::Vector2d>& ends_map,
                                            const std_msgs::Header& header);

/// A floor plan to look at. The first marker deletes what an earlier plan has left; then come the
/// outlines of the rooms ("rooms", one LINE_LIST), their openings ("openings", one LINE_LIST, from
/// jamb to jamb), and for each room its name or number, and its area ("room_labels", with the
/// room's id). Without rooms: the first one alone.
visualization_msgs::MarkerArray planMarkers(const FloorPlan& plan, const std_msgs::Header& header);

/// The robot to look at: its disc, an arrow ahead, and below it (as seen from above, north up) what
/// it does. @param radius  m.
visualization_msgs::MarkerArray robotMarkers(const Pose2& T_map_robot, double radius,
                                             const std::string& words,
                                             const std_msgs::Header& header);

}  // namespace cca
