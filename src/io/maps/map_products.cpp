// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/map_products.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "io/files/memory_file.hpp"
#include "io/maps/map_folder.hpp"
#include "io/maps/map_frame.hpp"
#include "io/maps/map_picture.hpp"
#include "io/maps/map_scene.hpp"
#include "io/maps/metric_map.hpp"
#include "io/maps/occupancy_files.hpp"
#include "io/plans/plan_files.hpp"
#include "io/poses/local_frame.hpp"
#include "io/replay/replay.hpp"

namespace cca {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSummary = "summary.json";
/// What writeMapFolder() writes always, and where the products hold it.
constexpr const char* kAlways[] = {kSummary,         "lines.csv", "arcs.csv",
                                   "lines.geojson",  "lines.svg", "lines.dxf",
                                   "map.linemap.gz", "map.png",   "scene.3Dscene"};
/// Or what only some runs write, of a drive of the simulation or of poses in a map.
constexpr const char* kSometimes[] = {"map.pgm",      "map.yaml",        "map.gridmap.gz",
                                      "poses.csv",    "poses.tum",       "graph.g2o",
                                      kMemoryFile,    "replay.html",     "trajectory.csv",
                                      "coverage.csv", "covariances.csv", "localisation.png"};
/// Names of files and what is found in damaged ones need not be UTF-8.
constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;

std::string inFolder(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

nlohmann::ordered_json summarize(const MapProducts& products) {
  double length = 0.0;
  for (const MapLine& line : products.lines) length += line.segment.length();
  auto summary = products.summary;
  summary["title"] = products.title;
  if (!products.origin.isZero()) {
    summary["frame_origin_m"] = {products.origin.x(), products.origin.y()};
  }
  summary["map_lines"] = products.lines.size();
  summary["map_poly_lines"] = products.poly_lines.size();
  summary["map_arcs"] = products.arcs.size();
  summary["map_length_m"] = length;
  return summary;
}

/// Writes the floor plan beside the map, and its numbers into the summary. A map is a map without a
/// plan, too: what goes wrong with it goes into the summary. @param map  in the map frame, its grid
/// asWritten(). @return  the plan, if it was written.
std::optional<FloorPlan> addPlan(const std::string& folder, const MapProducts& map,
                                 nlohmann::ordered_json& summary) {
  if (!map.grid) return std::nullopt;
  try {
    const FloorPlan plan = planOfMap(map.lines, *map.grid);
    writePlanFiles(folder, planFiles(plan, map.title, map.place), true);
    double area = 0.0;
    for (const PlanRoom& room : plan.rooms) area += room.area;
    summary["plan"] = {
        {"rooms", plan.rooms.size()}, {"openings", plan.openings.size()}, {"floor_m2", area}};
    return plan;
  } catch (const std::exception& error) {
    summary["plan"] = {{"error", error.what()}};
    return std::nullopt;
  }
}

}  // namespace

FolderLock prepareMapFolder(const std::string& folder, bool overwrite,
                            const std::vector<const char*>& beside,
                            const std::vector<std::string>& inputs) {
  makeFolder(folder);
  const auto mayWrite = [&](const char* name) {
    requireNew(inFolder(folder, name), overwrite);
    for (const std::string& input : inputs) requireApart(inFolder(folder, name), {input});
  };
  for (const char* name : kAlways) mayWrite(name);
  for (const char* name : kSometimes) mayWrite(name);
  for (const char* name : kPlanFiles) mayWrite(name);
  for (const char* name : beside) mayWrite(name);
  AtomicFile probe(inFolder(folder, kSummary));  // fails now, not after the work
  removeLeftovers(folder);
  return FolderLock(folder);
}

void withdrawSummary(const std::string& folder) {
  std::error_code none_there;
  fs::remove(inFolder(folder, kSummary), none_there);
}

std::string keepMemory(const std::string& folder) {
  if (!fs::exists(inFolder(folder, kMemoryFile))) return {};
  std::string kept = inFolder(folder, "earlier.slam");
  for (int number = 2; fs::exists(kept); ++number) {
    kept = inFolder(folder, "earlier-" + std::to_string(number) + ".slam");
  }
  std::error_code failed;
  fs::rename(inFolder(folder, kMemoryFile), kept, failed);
  if (failed) throw std::runtime_error(kept + ": " + failed.message());
  return kept;
}

void writeMapFolder(const std::string& folder, const MapProducts& products) {
  makeFolder(folder);
  withdrawSummary(folder);
  MapProducts map = seenFrom(-products.origin, products);
  if (map.grid) map.grid = asWritten(std::move(*map.grid), products.origin);
  std::vector<std::string> written = products.beside;
  const auto put = [&](const std::string& name, const std::string& content) {
    writeFile(inFolder(folder, name), content);
    written.push_back(name);
  };
  for (const auto& [name, content] : mapTexts(map)) put(name, content);
  writeLineMap(inFolder(folder, "map.linemap.gz"), map.lines);
  if (products.grid) {
    writeGridMap(inFolder(folder, "map.gridmap.gz"), *products.grid);
    written.push_back("map.gridmap.gz");
  }
  auto summary = summarize(products);
  const std::optional<FloorPlan> plan = addPlan(folder, map, summary);
  if (plan) written.insert(written.end(), kPlanFiles.begin(), kPlanFiles.end());
  PictureOptions picture;
  if (plan) picture.rooms = seenFrom(products.origin, plan->rooms);
  MapProducts drawn = products;
  // As who reads the files draws it, wherever the frame lies.
  if (drawn.grid) drawn.grid = asWritten(std::move(*drawn.grid), Eigen::Vector2d::Zero());
  writePicture(inFolder(folder, "map.png"), drawn, picture);
  writeScene(inFolder(folder, "scene.3Dscene"), products);
  if (!map.replay.empty()) put("replay.html", replayPage({withRooms(map.replay, picture.rooms)}));
  // What an earlier run left would be taken for this one's.
  const auto removeOld = [&](const char* name) {
    std::error_code none_there;
    if (std::find(written.begin(), written.end(), name) == written.end())
      fs::remove(inFolder(folder, name), none_there);
  };
  for (const char* name : kSometimes) removeOld(name);
  for (const char* name : kPlanFiles) removeOld(name);
  put(kSummary, summary.dump(2, ' ', false, kReplace) + "\n");
}

}  // namespace cca
