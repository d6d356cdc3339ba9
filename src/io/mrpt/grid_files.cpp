// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/maps/COccupancyGridMap2D.h>

#include "io/files/gzip_archive.hpp"
#include "io/maps/occupancy_files.hpp"
#include "simulation/occupancy_image.hpp"

namespace cca {

OccupancyRaster readOccupancyMap(const std::string& yaml_path) {
  const OccupancyImage map = readOccupancyImage(yaml_path);
  OccupancyRaster grid;
  grid.columns = map.columns;
  grid.rows = map.rows;
  grid.resolution = map.resolution;
  grid.origin = map.origin;
  grid.values.reserve(map.shades.size());
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const double occupied = map.occupancy(column, row);
      grid.values.push_back(occupied > map.occupied_thresh ? Occupancy::kOccupied
                            : occupied < map.free_thresh   ? Occupancy::kFree
                                                           : Occupancy::kUnknown);
    }
  }
  return grid;
}

void writeGridMap(const std::string& path, const OccupancyRaster& grid) {
  const auto left = static_cast<float>(grid.origin.x()), low = static_cast<float>(grid.origin.y()),
             side = static_cast<float>(grid.resolution);
  mrpt::maps::COccupancyGridMap2D cells;
  cells.setSize(left, left + static_cast<float>(grid.columns) * side, low,
                low + static_cast<float>(grid.rows) * side, side);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Occupancy state = grid[{column, row}];
      cells.setCell(column, row,
                    state == Occupancy::kFree       ? 1.0F
                    : state == Occupancy::kOccupied ? 0.0F
                                                    : 0.5F);
    }
  }
  GzipArchive file(path);
  file.write(cells);
  file.commit();
}

}  // namespace cca
