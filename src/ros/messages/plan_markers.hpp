// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "cca_mrpt/floor_plan/floor_plan.hpp"

namespace cca {

/// A floor plan to look at. The first marker deletes what an earlier plan has left; then come the
/// outlines of the rooms ("rooms", one LINE_LIST), their openings ("openings", one LINE_LIST, from
/// jamb to jamb), and for each room its name or number, and its area ("room_labels", with the
/// room's id). Without rooms: the first one alone.
visualization_msgs::MarkerArray planMarkers(const FloorPlan& plan, const std_msgs::Header& header);

}  // namespace cca
