// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <Eigen/Core>
#include <memory>
#include <string>

namespace cca {

/// Probabilities of being occupied, map_server's customary thresholds.
inline constexpr float kOccupiedFrom = 0.65F, kFreeBelow = 0.196F;

/// Writes NAME.pgm and NAME.yaml in map_server's trinary format: occupied 0, free 254, unknown 205;
/// rows from the top, origin at the lower left corner. NAME is a path without extension.
/// MRPT's loadFromROSMapServerYAML() and ROS's map_server read them.
/// @param p_frame  m, map frame: where the grid's frame lies.
/// @throws std::runtime_error naming the file and the reason.
void writeOccupancyMap(const std::string& path_without_extension,
                       const mrpt::maps::COccupancyGridMap2D& grid,
                       const Eigen::Vector2d& p_frame = Eigen::Vector2d::Zero());

/// Reads a map of map_server, as it looks from a frame that lies at p_frame: occupied 0, free 1,
/// unknown one half.
/// @throws std::runtime_error as readOccupancyImage() does.
std::shared_ptr<mrpt::maps::COccupancyGridMap2D> readOccupancyMap(const std::string& yaml_path,
                                                                  const Eigen::Vector2d& p_frame);

/// Writes MRPT's own file of the grid (.gridmap.gz).
/// @throws std::runtime_error naming the file and the reason.
void writeGridMap(const std::string& path, const mrpt::maps::COccupancyGridMap2D& grid);

}  // namespace cca
