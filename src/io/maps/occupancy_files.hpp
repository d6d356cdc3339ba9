// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "cca_mrpt/floor_plan/raster.hpp"

namespace cca {

/// A grid as a picture of map_server's, NAME.pgm: occupied 0, free 254, unknown 205; rows from the
/// top.
std::string occupancyPgm(const OccupancyRaster& grid);

/// What NAME.yaml says of it: its origin is the lower left corner, thresholds are map_server's
/// customary ones. MRPT's loadFromROSMapServerYAML() and ROS's map_server read the two.
/// @param image  the picture's file name.
std::string occupancyYaml(const OccupancyRaster& grid, const std::string& image);

/// The grid in the frame in which one that lies at p_frame is its own, as its files tell it: to the
/// micrometre.
OccupancyRaster asWritten(OccupancyRaster grid, const Eigen::Vector2d& p_frame);

/// Reads a map of map_server, by its own thresholds.
/// @throws std::runtime_error as readOccupancyImage() does.
OccupancyRaster readOccupancyMap(const std::string& yaml_path);

/// Writes MRPT's own file of a grid (.gridmap.gz): free 1, occupied 0, unknown one half.
/// @throws std::runtime_error naming the file and the reason.
void writeGridMap(const std::string& path, const OccupancyRaster& grid);

}  // namespace cca
