// SPDX-License-Identifier: BSD-3-Clause
#include "io/plans/plan_files.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/files/atomic_file.hpp"
#include "io/files/text.hpp"
#include "io/lines/line_formats.hpp"
#include "io/plans/plan_formats.hpp"

namespace cca {

namespace fs = std::filesystem;

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

std::string titleOfFolder(const std::string& folder) {
  const fs::path summary = fs::path(folder) / "summary.json";
  if (fs::exists(summary)) {
    const auto json = nlohmann::json::parse(contentOf(summary.string()), nullptr, false);
    if (json.is_object() && json.contains("title") && json["title"].is_string()) {
      return json["title"];
    }
  }
  return fs::weakly_canonical(folder).filename().string();
}

FloorPlan planOfMap(const std::vector<MapLine>& lines, const OccupancyRaster& grid) {
  return floorPlan(grid, readLinesCsv(linesCsv(lines), "lines.csv"));
}

NamedFiles planTexts(const FloorPlan& plan, const std::string& title,
                     const std::optional<GeoReference>& place) {
  return {{"plan.geojson", planGeoJson(plan, place)},
          {"plan.svg", planSvg(plan, title, place)},
          {"plan.dxf", planDxf(plan)},
          {"rooms.csv", roomsCsv(plan)}};
}

void writePlanFiles(const std::string& folder, const NamedFiles& files, bool overwrite) {
  for (const auto& [name, content] : files) {
    const std::string path = (fs::path(folder) / name).string();
    const bool is_same = !overwrite && fs::exists(path) && contentOf(path) == content;
    requireNew(path, overwrite || is_same);
  }
  makeFolder(folder);
  for (const auto& [name, content] : files) writeFile((fs::path(folder) / name).string(), content);
}

}  // namespace cca
