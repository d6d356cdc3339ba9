// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"
#include "cca_mrpt/io/geo_reference.hpp"
#include "cca_mrpt/mapping/line_map.hpp"

namespace cca {

/// A floor plan as a GeoJSON FeatureCollection: longitude and latitude where the place of the map
/// on the Earth is told (`origin` keeps it), else metres of the map frame, which a `note` says.
/// Properties are in metres of the map frame always. Each feature has `kind` and `id`:
/// - "room": Polygon with holes; `name` ("" unless given), `area_m2`, `perimeter_m`,
///   `unseen_area_m2`, `open_border_m`, `label_point`;
/// - "door", "opening": LineString from jamb to jamb; `width_m`, `rooms` (two ids), and of an
///   opening `type` ("passage", "wide");
/// - "wall": LineString, the centre line, or the face of a wall of one face; `thickness_m` (null
/// for
///   one face), `faces` (2, 1, or 0 where presumed), `left_line_ids`, `right_line_ids`, `presumed`;
/// - "furniture": Polygon; `leaning`, `room` (id or null).
std::string planGeoJson(const FloorPlan& plan, const std::optional<GeoReference>& place = {});

/// Rooms as CSV, header `id,name,x,y,area_m2,perimeter_m,unseen_area_m2,open_border_m,doors`: a
/// point inside of each [m, map frame], measures, and its doors and openings by number.
std::string roomsCsv(const FloorPlan& plan);

/// A floor plan as DXF R2000, in metres. Layers: A-WALL (faces of walls), A-WALL-PRSM
/// (presumed ones), A-DOOR, A-OPNG, A-AREA (rooms), A-AREA-IDEN (their names and areas), A-FURN.
std::string planDxf(const FloorPlan& plan);

/// How a plan of ours is known among other drawings, and which groups of it a laser may see.
inline constexpr const char *kPlanSvgId = "cca_mrpt_plan", *kWallLayer = "walls",
                            *kFurnitureLayer = "furniture";
/// Its attribute that places the sheet: from millimetres of the sheet to metres of the map frame, y
/// down, as a transform.
inline constexpr const char* kPlanSvgPlace = "data-to-metres";

/// A floor plan to scale as SVG, with names, areas, widths of doors, dimensions and a legend; in
/// groups by what they show.
/// @param title  for people.
/// @param place  an arrow shows where north is; nothing: no arrow. A scale bar is always there.
std::string planSvg(const FloorPlan& plan, const std::string& title,
                    const std::optional<GeoReference>& place = {});

/// Names for rooms: a point in the room [m, map frame], and its name.
using RoomLabels = std::vector<std::pair<Eigen::Vector2d, std::string>>;

/// Reads a CSV whose header names x, y and name; a name may stand in double quotes. Fields are
/// parted by commas, or by semicolons, and then numbers may have a decimal comma.
/// @param file  its name, for messages.
/// @throws std::runtime_error naming file, row and column of what is missing, empty or no finite
/// number.
RoomLabels readRoomLabels(const std::string& text, const std::string& file);

/// The same of a file. @throws std::runtime_error where it cannot be read, too.
RoomLabels roomLabelsOfFile(const std::string& path);

/// Gives rooms the names of the labels that lie in them; of several in one room the first counts.
/// @return  the labels that lie in no room.
RoomLabels nameRooms(FloorPlan& plan, const RoomLabels& labels);

}  // namespace cca
