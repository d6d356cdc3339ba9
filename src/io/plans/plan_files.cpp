// SPDX-License-Identifier: BSD-3-Clause
#include "io/plans/plan_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "io/files/atomic_file.hpp"
#include "io/lines/line_formats.hpp"
#include "io/maps/occupancy_files.hpp"
#include "io/plans/plan_formats.hpp"
#include "io/plans/plan_reader_formats.hpp"
#include "io/poses/local_frame.hpp"

namespace cca {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPicture = "rooms.png";

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path)) throw std::runtime_error(path.string() + ": cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Each file but the picture, and what it will hold.
std::vector<std::pair<std::string, std::string>> drawn(const FloorPlan& plan,
                                                       const std::string& title) {
  return {{"plan.geojson", planGeoJson(plan)},
          {"plan.svg", planSvg(plan, title)},
          {"plan.dxf", planDxf(plan)},
          {"plan.pdf", planPdf(plan, title)},
          {"rooms.csv", roomsCsv(plan)}};
}

void requireCommonPlace(const std::vector<MapLine>& lines, const OccupancyRaster& grid,
                        const std::string& yaml) {
  const Eigen::Vector2d size = grid.resolution * Eigen::Vector2d(grid.columns, grid.rows);
  const auto is_on_grid = [&](const Eigen::Vector2d& p_map) {
    const Eigen::Vector2d p = p_map - grid.origin;
    return p.minCoeff() >= 0.0 && (size - p).minCoeff() >= 0.0;
  };
  const bool has_common = std::any_of(lines.begin(), lines.end(), [&](const MapLine& line) {
    return is_on_grid(line.segment.start) || is_on_grid(line.segment.end);
  });
  if (!lines.empty() && !has_common)
    throw std::runtime_error(yaml + ": origin: no line of lines.csv ends on this grid");
}

void requireNew(const fs::path& path) {
  throw std::runtime_error(path.string() + ": is there already (--force overwrites it)");
}

}  // namespace

OccupancyRaster occupancyOf(const mrpt::maps::COccupancyGridMap2D& grid,
                            const Eigen::Vector2d& p_frame) {
  OccupancyRaster raster;
  raster.columns = static_cast<int>(grid.getSizeX());
  raster.rows = static_cast<int>(grid.getSizeY());
  // As map.yaml says it: both are single precision there and here.
  raster.resolution = std::stod(std::to_string(grid.getResolution()));
  const auto rounded = [](double metres) { return std::round(1e6 * metres) / 1e6; };
  raster.origin = {rounded(p_frame.x() + grid.getXMin()), rounded(p_frame.y() + grid.getYMin())};
  raster.values.reserve(grid.getSizeX() * grid.getSizeY());
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column) {
      const float occupied = 1.0F - grid.getCell(column, row);
      raster.values.push_back(occupied > kOccupiedFrom ? Occupancy::kOccupied
                              : occupied < kFreeBelow  ? Occupancy::kFree
                                                       : Occupancy::kUnknown);
    }
  }
  return raster;
}

PlanFile readGridPlan(const std::string& yaml_path) {
  return gridPlan(occupancyOf(*readOccupancyMap(yaml_path, {0.0, 0.0}), {0.0, 0.0}));
}

FloorPlan planOfFolder(const std::string& folder) {
  if (!fs::is_directory(folder)) throw std::runtime_error(folder + ": is no folder of a map");
  const fs::path lines_csv = fs::path(folder) / "lines.csv", yaml = fs::path(folder) / "map.yaml";
  const std::vector<MapLine> lines = readLinesCsv(contentOf(lines_csv), lines_csv.string());
  contentOf(yaml);
  std::vector<Eigen::Vector2d> places;
  for (const MapLine& line : lines) places.push_back(line.segment.start);
  const Eigen::Vector2d frame = localOrigin(medianPlace(places));
  const OccupancyRaster raster = occupancyOf(*readOccupancyMap(yaml.string(), frame), frame);
  requireCommonPlace(lines, raster, yaml.string());
  return floorPlan(raster, lines);
}

std::string titleOfFolder(const std::string& folder) {
  const fs::path summary = fs::path(folder) / "summary.json";
  if (fs::exists(summary)) {
    const auto json = nlohmann::json::parse(contentOf(summary), nullptr, false);
    if (json.is_object() && json.contains("title") && json["title"].is_string()) {
      return json["title"];
    }
  }
  return fs::weakly_canonical(folder).filename().string();
}

FloorPlan planOfMap(const std::vector<MapLine>& lines, const mrpt::maps::COccupancyGridMap2D& grid,
                    const Eigen::Vector2d& p_frame) {
  return floorPlan(occupancyOf(grid, p_frame), readLinesCsv(linesCsv(lines), "lines.csv"));
}

void writePlanFiles(const std::string& folder, const FloorPlan& plan, const std::string& title,
                    bool overwrite) {
  const auto files = drawn(plan, title);
  bool is_same = true;
  for (const auto& [name, content] : files) {
    const fs::path path = fs::path(folder) / name;
    const bool is_there = fs::exists(path);
    is_same = is_same && is_there && contentOf(path) == content;
    if (is_there && !overwrite && contentOf(path) != content) requireNew(path);
  }
  const fs::path picture = fs::path(folder) / kPicture;
  if (fs::exists(picture) && !overwrite && !is_same) requireNew(picture);
  makeFolder(folder);
  for (const auto& [name, content] : files) writeFile((fs::path(folder) / name).string(), content);
  writePlanPng(picture.string(), plan, title);
}

}  // namespace cca
