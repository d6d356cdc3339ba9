// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <string>

namespace cca {

/// Writes NAME.pgm and NAME.yaml in map_server's trinary format: occupied 0, free 254, unknown 205;
/// rows from the top, origin at the lower left corner. NAME is a path without extension.
/// MRPT's loadFromROSMapServerYAML() and ROS's map_server read them.
/// @throws std::runtime_error naming the file and the reason.
void writeOccupancyMap(const std::string& path_without_extension,
                       const mrpt::maps::COccupancyGridMap2D& grid);

/// Writes MRPT's own file of the grid (.gridmap.gz), with full probabilities.
/// @throws std::runtime_error naming the file and the reason.
void writeGridMap(const std::string& path, const mrpt::maps::COccupancyGridMap2D& grid);

}  // namespace cca
