// SPDX-License-Identifier: BSD-3-Clause
#include "map_record.hpp"

#include <stdexcept>

namespace cca {

void MapRecord::add(const Scan& scan, const Pose2& T_map_robot) {
  grid.insert(scan);
  way.push_back(T_map_robot);
}

void MapRecord::correct(const PastScans& past, std::size_t remembered) {
  *this = MapRecord();
  for (const auto& kept : past.kept()) {
    if (kept.sensor == 0 && kept.step >= remembered) {
      add(kept.scan, kept.T_map_robot);
    } else {
      addBeside(kept.scan);
    }
  }
}

MapProducts MapRecord::products(const std::string& title, const LineMap& line_map) const {
  if (way.empty()) throw std::runtime_error("there is no map yet");
  MapProducts products;
  products.title = title;
  products.lines = line_map.lines();
  products.poly_lines = line_map.polyLines();
  products.arcs = line_map.arcs();
  products.trajectory = way;
  products.grid = std::make_shared<mrpt::maps::COccupancyGridMap2D>(*grid.grid());
  return products;
}

}  // namespace cca
