// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <array>
#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"

namespace cca {

/// What writePlanFiles() writes.
inline constexpr std::array<const char*, 6> kPlanFiles{
    {"plan.geojson", "plan.svg", "plan.dxf", "plan.pdf", "rooms.csv", "rooms.png"}};

/// A grid as the floor plan takes it, by the thresholds of writeOccupancyMap().
/// @param p_frame  m, map frame: where the grid's frame lies.
OccupancyRaster occupancyOf(const mrpt::maps::COccupancyGridMap2D& grid,
                            const Eigen::Vector2d& p_frame);

/// The plan of what lies in a map's folder: its lines.csv, and its map.yaml with the image.
/// @throws std::runtime_error naming the file that is missing or cannot be read.
FloorPlan planOfFolder(const std::string& folder);

/// What a map's folder is the map of, as its summary.json says; else the folder's name.
std::string titleOfFolder(const std::string& folder);

/// The plan of the same lines and grid before they are written: planOfFolder() gives the same.
FloorPlan planOfMap(const std::vector<MapLine>& lines, const mrpt::maps::COccupancyGridMap2D& grid,
                    const Eigen::Vector2d& p_frame);

/// Writes kPlanFiles. All are drawn before the first one is written; each appears whole or not at
/// all. The folder is made where it is missing.
/// @param overwrite  else files that are there already and differ stop it before it writes any.
/// @throws std::runtime_error naming the file and the reason.
void writePlanFiles(const std::string& folder, const FloorPlan& plan, const std::string& title,
                    bool overwrite);

}  // namespace cca
