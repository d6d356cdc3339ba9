// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/io/geo_reference.hpp"
#include "cca_mrpt/mapping/line_map.hpp"

namespace cca {

inline constexpr double kFarthestPlan = 1e8;  ///< m, from (0, 0): beyond, it is in other units

/// A line map as CSV, header
/// `x1,y1,x2,y2,id,support,length,sigma_offset,sigma_angle_deg,kind,share,sigma_start,sigma_end`:
/// end points [m, map frame], stable id, laser returns, length [m], the standard deviations of the
/// line's lateral offset at its middle [m] and of its orientation [deg], `wall` or `dotted`, the
/// share of its length that returns, and the standard deviations of its offset at its ends [m].
std::string linesCsv(const std::vector<MapLine>& lines);

/// Reads linesCsv() back, and any CSV whose header names x1, y1, x2 and y2, by commas, or by
/// semicolons and then with decimal commas or points.
/// @param name  of the file, for messages.
/// @throws std::runtime_error naming file, row and column of what is missing, no number, or farther
///         than kFarthestPlan.
std::vector<MapLine> readLinesCsv(const std::string& text, const std::string& name);

/// A line map as a GeoJSON FeatureCollection: longitude and latitude where the place of the map on
/// the Earth is told (`origin` keeps it), else metres of the map frame, which a `note` says.
/// Each line is a LineString with `kind` "line", `id`, `support`, `share`, `line_kind` ("wall" or
/// "dotted"), `length` and `covariance` (offset-offset, offset-angle, angle-angle; m^2, m rad,
/// rad^2); each poly-line one more with `kind` "poly_line", `length` and `line_ids`; each arc one
/// with `kind` "arc", `centre`, `radius`, `start_deg`, `sweep_deg` and `line_ids`, its coordinates
/// 5 degrees apart; the trajectory, where there is one, a last with `kind` "trajectory". Properties
/// are in metres of the map frame always.
std::string linesGeoJson(const std::vector<MapLine>& lines, const std::vector<PolyLine>& poly_lines,
                         const std::vector<Pose2>& trajectory = {},
                         const std::vector<MapArc>& arcs = {},
                         const std::optional<GeoReference>& place = {});

/// What linesGeoJson() holds besides the lines.
struct ChainsAndTrajectory {
  std::vector<PolyLine> poly_lines;
  std::vector<Pose2> trajectory;  ///< headings are those of the way
};

/// Reads linesGeoJson() back, into metres of the map frame.
/// @throws std::runtime_error naming the file where the text is no such thing.
ChainsAndTrajectory readLinesGeoJson(const std::string& text, const std::string& name);

/// A floor plan to scale (1 : 100, when printed unscaled) as SVG: poly-lines as polylines, what is
/// part of none as lines, dashed where they are dotted; ids and supports as data attributes.
/// @param trajectory  drawn thin below the lines; may be empty.
/// @param arcs        drawn thin beside their chords.
/// @param place       an arrow shows where north is; nothing: no arrow. A scale bar is always
/// there.
std::string linesSvg(const std::vector<MapLine>& lines, const std::vector<PolyLine>& poly_lines,
                     const std::vector<Pose2>& trajectory, const std::vector<MapArc>& arcs = {},
                     const std::optional<GeoReference>& place = {});

/// A floor plan as DXF of AutoCAD 2000, which says that its unit is the metre: layers POLYLINES,
/// DOTTED (dotted walls, which are in no chain), LINES (all walls one by one; switched off), ARCS
/// and TRAJECTORY. Arcs are ARC or CIRCLE; their chords stay.
std::string linesDxf(const std::vector<MapLine>& lines, const std::vector<PolyLine>& poly_lines,
                     const std::vector<Pose2>& trajectory, const std::vector<MapArc>& arcs = {});

/// Arcs as CSV, header `x,y,radius,start_deg,sweep_deg,sigma_x,sigma_y,sigma_radius,line_ids`:
/// centre and radius [m, map frame] with their standard deviations, where the arc begins about its
/// centre and how far it goes counter-clockwise (360: a circle), and the lines that are its chords,
/// by blanks.
std::string arcsCsv(const std::vector<MapArc>& arcs);

/// m, for a scale bar: the longest of 1, 2 and 5 times powers of ten that is no longer than `most`.
double scaleBarLength(double most);

/// The lines that are part of no poly-line.
std::vector<MapLine> loneLines(const std::vector<MapLine>& lines,
                               const std::vector<PolyLine>& poly_lines);

}  // namespace cca
