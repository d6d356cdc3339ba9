// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <optional>
#include <string>

#include "cca_mrpt/mapping/pose2.hpp"

namespace cca {

/// A static world: a map_server map (YAML + image) in MRPT's occupancy grid. All that is not free,
/// unknown cells and everything beyond the image too, is an obstacle.
struct World {
  std::string name;  ///< file name without extension
  mrpt::maps::COccupancyGridMap2D grid;
  std::optional<Pose2> start;  ///< from the YAML's `start: [x, y, yaw_deg]`
};

/// @throws std::runtime_error naming file, key and what is allowed.
World loadWorld(const std::string& yaml_path);

}  // namespace cca
