// SPDX-License-Identifier: BSD-3-Clause
// Example 2: a map from a log, and its files. Link cca_mrpt::io.
// Usage: 2_map_from_a_log LOG FOLDER
#include <cstdio>
#include <exception>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/scan_raster.hpp"
#include "cca_mrpt/mapping/line_map.hpp"

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: 2_map_from_a_log LOG FOLDER\n");
    return 2;
  }
  cca::LineMap map;
  cca::ScanRaster grid;  // for the picture's background and map.pgm
  cca::MapProducts products;
  const auto log = cca::openLog(argv[1]);
  while (const auto record = log->next()) {
    map.insert(record->scan);
    grid.insert(record->scan);
    products.trajectory.push_back(record->scan.T_map_sensor * record->T_robot_sensor.inverse());
  }

  products.title = argv[1];
  products.lines = map.lines();
  products.poly_lines = map.polyLines();
  products.grid = grid.raster();
  cca::writeMapFolder(argv[2], products);
  std::printf("%zu scans, %zu lines\n", products.trajectory.size(), products.lines.size());
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
