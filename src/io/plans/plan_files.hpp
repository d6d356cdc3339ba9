// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"
#include "cca_mrpt/io/geo_reference.hpp"

namespace cca {

/// What planFiles() holds.
inline constexpr std::array<const char*, 6> kPlanFiles{
    {"plan.geojson", "plan.svg", "plan.dxf", "plan.pdf", "rooms.csv", "rooms.png"}};

/// The plan of what lies in a map's folder: its lines.csv, and its map.yaml with the image.
/// @throws std::runtime_error naming the file that is missing or cannot be read.
FloorPlan planOfFolder(const std::string& folder);

/// What a map's folder is the map of, as its summary.json says; else the folder's name.
std::string titleOfFolder(const std::string& folder);

/// The plan of the same lines and grid before they are written: planOfFolder() gives the same.
/// @param grid  as it will be written, see asWritten().
FloorPlan planOfMap(const std::vector<MapLine>& lines, const OccupancyRaster& grid);

/// @throws std::runtime_error naming the grid's file where no line ends on it.
void requireCommonPlace(const std::vector<MapLine>& lines, const OccupancyRaster& grid,
                        const std::string& yaml);

/// Rooms in the frame that lies at p_frame in theirs, to the micrometre: what is drawn does not
/// depend on where that is.
std::vector<PlanRoom> seenFrom(const Eigen::Vector2d& p_frame, std::vector<PlanRoom> rooms);

/// Names, and what the files of that name hold.
using NamedFiles = std::vector<std::pair<std::string, std::string>>;

/// plan.geojson, plan.svg, plan.dxf and rooms.csv. @param title  for people. @param place  see
/// planGeoJson().
NamedFiles planTexts(const FloorPlan& plan, const std::string& title,
                     const std::optional<GeoReference>& place = {});

/// These, and the same sheet as plan.pdf and rooms.png (1600 pixels). @throws std::runtime_error
/// with Cairo's reason.
NamedFiles planFiles(const FloorPlan& plan, const std::string& title,
                     const std::optional<GeoReference>& place = {});

/// Writes them; each appears whole or not at all. The folder is made where it is missing.
/// @param overwrite  else files that are there already and differ stop it before it writes any.
/// @throws std::runtime_error naming the file and the reason.
void writePlanFiles(const std::string& folder, const NamedFiles& files, bool overwrite);

}  // namespace cca
