// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/line_formats.hpp"
#include "dxf.hpp"

namespace cca {
namespace {

constexpr int kWhite = 7, kBlue = 5, kYellow = 2, kGreen = 3;  // AutoCAD's colour numbers

void head(Dxf& dxf) {
  dxf.group(999, "Line map; drawing unit 1 m");
  dxf.beginLayers(4);
  dxf.layer("POLYLINES", kWhite);
  dxf.layer("LINES", kBlue);
  dxf.layer("ARCS", kGreen);
  dxf.layer("TRAJECTORY", kYellow);
  dxf.beginEntities();
}

}  // namespace

std::string linesDxf(const std::vector<MapLine>& lines, const std::vector<PolyLine>& poly_lines,
                     const std::vector<Pose2>& trajectory, const std::vector<MapArc>& arcs) {
  Dxf dxf;
  head(dxf);
  for (const PolyLine& chain : poly_lines) dxf.polyLine(chain.vertices, "POLYLINES");
  for (const MapLine& line : loneLines(lines, poly_lines)) {
    dxf.line(line.segment.start, line.segment.end, "LINES");
  }
  for (const MapArc& arc : arcs) dxf.arc(arc.arc, "ARCS");
  if (trajectory.size() > 1) {
    std::vector<Eigen::Vector2d> path;
    for (const Pose2& pose : trajectory) path.push_back(pose.position());
    dxf.polyLine(path, "TRAJECTORY");
  }
  return dxf.finished();
}

}  // namespace cca
