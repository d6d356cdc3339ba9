// SPDX-License-Identifier: BSD-3-Clause
#include "dxf.hpp"
#include "io/lines/line_formats.hpp"

namespace cca {
namespace {

constexpr int kYellow = 2, kGreen = 3, kBlue = 5, kWhite = 7, kGrey = 8;  // AutoCAD's colours

}  // namespace

std::string linesDxf(const std::vector<MapLine>& lines, const std::vector<PolyLine>& poly_lines,
                     const std::vector<Pose2>& trajectory, const std::vector<MapArc>& arcs) {
  // A chain is drawn once: its lines, each with its own length, are there to be switched on.
  Dxf dxf({{"POLYLINES", kWhite},
           {"DOTTED", kGrey},
           {"LINES", -kBlue},
           {"ARCS", kGreen},
           {"TRAJECTORY", kYellow}});
  for (const PolyLine& chain : poly_lines) dxf.polyLine(chain.vertices, "POLYLINES");
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    if (line.kind == LineKind::kDotted) dxf.line(s.start, s.end, "DOTTED");
    dxf.line(s.start, s.end, "LINES");
  }
  for (const MapArc& arc : arcs) dxf.arc(arc.arc, "ARCS");
  if (trajectory.size() > 1) {
    std::vector<Eigen::Vector2d> path;
    for (const Pose2& pose : trajectory) path.push_back(pose.position());
    dxf.polyLine(path, "TRAJECTORY");
  }
  return dxf.file();
}

}  // namespace cca
