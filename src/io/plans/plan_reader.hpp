// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "cca_mrpt/mapping/line_map.hpp"
#include "known_map/plan_lines.hpp"

namespace cca {

/// The lines of a finished map, or of a plan that somebody has drawn.
struct PlanFile {
  std::string kind;             ///< for people: "DXF", "map_server grid", ...
  std::vector<PlanLine> lines;  ///< m, map frame
  /// What the file holds besides, which is no line: for people, "12 TEXT, 3 HATCH"; empty: nothing.
  std::string not_understood;
  std::vector<LineSigma> sigmas;  ///< one a line, where the file tells (.csv of ours); else empty
};

/// The plan that a map_server grid is. @throws std::runtime_error naming the file and the reason.
PlanFile readGridPlan(const std::string& yaml_path);

/// Reads a plan, by the ending of its name:
/// - a folder of `map` or `explore`, or .csv: lines.csv;
/// - .slam: map.slam, of which the lines are made anew;
/// - .geojson, .json: LineString, MultiLineString, Polygon, MultiPolygon, in metres; ours also in
///   longitude and latitude, where it tells its origin. Rooms, doors, openings, the trajectory, and
///   what is told twice, are left out, walls of a thickness have two faces;
/// - .dxf (ASCII): LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE of the ENTITIES, in the drawing's units
///   ($INSUNITS; metres where it tells none). Layers that are off or frozen, and those of doors,
///   openings, areas, notes and of our trajectory, are left out;
/// - .svg: line, polyline, polygon, rect and path (M, L, H, V, Z), by the transforms of its groups;
///   y points down the page, and a user unit is a metre; of our plan.svg walls and furniture alone,
///   where the map has them;
/// - .yaml: a map_server grid: the faces of its occupied cells towards free ones.
///
/// @param scale  m, of a unit of the drawing or .csv; 0: as the file tells, see above.
/// @param read_grid  how .yaml is read.
/// @throws std::runtime_error naming the file and the rule that it breaks; also where it holds no
///         line, and where it tells its own metres (.slam, .yaml, degrees) and a scale is given.
PlanFile readPlan(const std::string& path, double scale = 0.0,
                  const std::function<PlanFile(const std::string&)>& read_grid = readGridPlan);

/// m, map frame: the box that holds all. @param lines  one at least.
Eigen::AlignedBox2d boundsOf(const std::vector<PlanLine>& lines);

/// "12 lines within 8.0 x 6.0 m"
std::string sizeInWords(const std::vector<PlanLine>& lines);

/// The same lines as those of a map, for what draws such: numbered from 0, without support.
std::vector<MapLine> mapLinesOf(const std::vector<PlanLine>& plan);

}  // namespace cca
