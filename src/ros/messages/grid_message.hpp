// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <nav_msgs/OccupancyGrid.h>

namespace cca {

/// An MRPT grid as nav_msgs has it: P(occupied) in percent, -1 where it is still even. The header's
/// frame is that of the grid.
nav_msgs::OccupancyGrid gridMessage(const mrpt::maps::COccupancyGridMap2D& grid,
                                    const std_msgs::Header& header);

}  // namespace cca
