// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/map_products.hpp"

#include <filesystem>
#include <stdexcept>

#include "cca_mrpt/io/atomic_file.hpp"
#include "cca_mrpt/io/line_formats.hpp"
#include "cca_mrpt/io/map_picture.hpp"
#include "cca_mrpt/io/map_scene.hpp"
#include "cca_mrpt/io/metric_map.hpp"
#include "cca_mrpt/io/occupancy_files.hpp"

namespace cca {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSummary = "summary.json";
/// Names of files and what is found in damaged ones need not be UTF-8.
constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;

std::string inFolder(const std::string& folder, const char* name) {
  return (fs::path(folder) / name).string();
}

nlohmann::ordered_json summarize(const MapProducts& products) {
  double length = 0.0;
  for (const MapLine& line : products.lines) length += line.segment.length();
  auto summary = products.summary;
  summary["map_lines"] = products.lines.size();
  summary["map_poly_lines"] = products.poly_lines.size();
  summary["map_length_m"] = length;
  return summary;
}

}  // namespace

FolderLock prepareMapFolder(const std::string& folder, bool overwrite) {
  makeFolder(folder);
  const std::string summary = inFolder(folder, kSummary);
  if (fs::exists(summary) && !overwrite) {
    throw std::runtime_error(summary + ": there is a map already (--force overwrites it)");
  }
  AtomicFile probe(summary);  // fails now, not after the work
  return FolderLock(folder);
}

void withdrawSummary(const std::string& folder) {
  std::error_code none_there;
  fs::remove(inFolder(folder, kSummary), none_there);
}

void writeMapFolder(const std::string& folder, const MapProducts& products) {
  makeFolder(folder);
  withdrawSummary(folder);
  const auto& [title, lines, poly_lines, trajectory, grid, summary] = products;
  writeFile(inFolder(folder, "lines.csv"), linesCsv(lines));
  writeFile(inFolder(folder, "lines.geojson"), linesGeoJson(lines, poly_lines, trajectory));
  writeFile(inFolder(folder, "lines.svg"), linesSvg(lines, poly_lines, trajectory));
  writeFile(inFolder(folder, "lines.dxf"), linesDxf(lines, poly_lines, trajectory));
  writePicture(inFolder(folder, "map.png"), products);
  if (grid) {
    writeOccupancyMap(inFolder(folder, "map"), *grid);
    writeGridMap(inFolder(folder, "map.gridmap.gz"), *grid);
  }
  writeLineMap(inFolder(folder, "map.linemap.gz"), lines);
  writeScene(inFolder(folder, "scene.3Dscene"), products);
  writeFile(inFolder(folder, kSummary), summarize(products).dump(2, ' ', false, kReplace) + "\n");
}

}  // namespace cca
