// SPDX-License-Identifier: BSD-3-Clause
#include "map_record.hpp"

#include <stdexcept>

namespace cca {

void MapRecord::add(const Scan& scan, const Pose2& T_map_robot) {
  grid.insert(scan);
  way.push_back(T_map_robot);
}

MapProducts MapRecord::products(const std::string& title, const LineMap& line_map) const {
  if (way.empty()) throw std::runtime_error("there is no map yet");
  MapProducts products;
  products.title = title;
  products.lines = line_map.lines();
  products.poly_lines = line_map.polyLines();
  products.trajectory = way;
  products.grid = std::make_shared<mrpt::maps::COccupancyGridMap2D>(*grid.grid());
  return products;
}

}  // namespace cca
