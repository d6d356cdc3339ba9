// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/grid_message.hpp"

#include <cmath>

namespace cca {
namespace {

constexpr float kEven = 0.02f;  // MRPT's cells are 8 bits of log-odds: none is exactly one half

}  // namespace

nav_msgs::OccupancyGrid gridMessage(const mrpt::maps::COccupancyGridMap2D& grid,
                                    const std_msgs::Header& header) {
  nav_msgs::OccupancyGrid message;
  message.header = header;
  message.info.map_load_time = header.stamp;
  message.info.resolution = grid.getResolution();
  message.info.width = grid.getSizeX();
  message.info.height = grid.getSizeY();
  message.info.origin.position.x = grid.getXMin();
  message.info.origin.position.y = grid.getYMin();
  message.info.origin.orientation.w = 1.0;
  message.data.reserve(std::size_t{message.info.width} * message.info.height);
  for (unsigned y = 0; y < grid.getSizeY(); ++y) {
    for (unsigned x = 0; x < grid.getSizeX(); ++x) {
      const float occupied = 1.0f - grid.getCell(static_cast<int>(x), static_cast<int>(y));
      const bool unknown = std::abs(occupied - 0.5f) < kEven;
      message.data.push_back(static_cast<std::int8_t>(unknown ? -1 : std::lround(100 * occupied)));
    }
  }
  return message;
}

}  // namespace cca
