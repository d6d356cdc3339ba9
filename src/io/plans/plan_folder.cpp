// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <stdexcept>

#include "io/files/text.hpp"
#include "io/lines/line_formats.hpp"
#include "io/maps/occupancy_files.hpp"
#include "io/plans/plan_files.hpp"
#include "io/plans/plan_reader_formats.hpp"

namespace cca {

namespace fs = std::filesystem;

PlanFile readGridPlan(const std::string& yaml_path) {
  return gridPlan(readOccupancyMap(yaml_path));
}

FloorPlan planOfFolder(const std::string& folder) {
  if (!fs::is_directory(folder)) throw std::runtime_error(folder + ": is no folder of a map");
  const fs::path lines_csv = fs::path(folder) / "lines.csv", yaml = fs::path(folder) / "map.yaml";
  const std::vector<MapLine> lines =
      readLinesCsv(contentOf(lines_csv.string()), lines_csv.string());
  contentOf(yaml.string());
  const OccupancyRaster raster = readOccupancyMap(yaml.string());
  requireCommonPlace(lines, raster, yaml.string());
  return floorPlan(raster, lines);
}

}  // namespace cca
