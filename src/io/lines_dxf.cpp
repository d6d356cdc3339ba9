// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "cca_mrpt/io/line_formats.hpp"

namespace cca {
namespace {

/// DXF is pairs of lines: a group code, and its value.
class Dxf {
 public:
  Dxf& group(int code, const std::string& value) {
    text_ += std::to_string(code) + "\n" + value + "\n";
    return *this;
  }

  Dxf& group(int code, int value) { return group(code, std::to_string(value)); }

  Dxf& point(int code, const Eigen::Vector2d& p) {
    return number(code, p.x()).number(code + 10, p.y()).number(code + 20, 0.0);
  }

  void layer(const std::string& name, int colour) {
    group(0, "LAYER").group(2, name).group(70, 0).group(62, colour).group(6, "CONTINUOUS");
  }

  void line(const Eigen::Vector2d& start, const Eigen::Vector2d& end, const std::string& layer) {
    group(0, "LINE").group(8, layer).point(10, start).point(11, end);
  }

  void arc(const Arc& arc, const std::string& layer) {
    const double degrees = 180.0 / M_PI, start = arc.start_angle * degrees;
    const bool whole = arc.sweep >= 2.0 * M_PI;
    group(0, whole ? "CIRCLE" : "ARC").group(8, layer).point(10, arc.centre).number(40, arc.radius);
    if (!whole) number(50, start).number(51, start + arc.sweep * degrees);
  }

  void polyLine(const std::vector<Eigen::Vector2d>& vertices, const std::string& layer) {
    group(0, "POLYLINE").group(8, layer).group(66, 1).point(10, Eigen::Vector2d::Zero());
    group(70, 0);
    for (const auto& vertex : vertices) group(0, "VERTEX").group(8, layer).point(10, vertex);
    group(0, "SEQEND").group(8, layer);
  }

  const std::string& text() const { return text_; }

 private:
  Dxf& number(int code, double value) {
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.4f", value);
    return group(code, std::string(digits));
  }

  std::string text_;
};

constexpr int kWhite = 7, kBlue = 5, kYellow = 2, kGreen = 3;  // AutoCAD's colour numbers

void head(Dxf& dxf) {
  dxf.group(999, "Line map; drawing unit 1 m");
  dxf.group(0, "SECTION").group(2, "HEADER").group(9, "$ACADVER").group(1, "AC1009");
  dxf.group(0, "ENDSEC").group(0, "SECTION").group(2, "TABLES");
  dxf.group(0, "TABLE").group(2, "LTYPE").group(70, 1).group(0, "LTYPE").group(2, "CONTINUOUS");
  dxf.group(70, 64).group(3, "Solid line").group(72, 65).group(73, 0).group(40, "0.0");
  dxf.group(0, "ENDTAB").group(0, "TABLE").group(2, "LAYER").group(70, 4);
  dxf.layer("POLYLINES", kWhite);
  dxf.layer("LINES", kBlue);
  dxf.layer("ARCS", kGreen);
  dxf.layer("TRAJECTORY", kYellow);
  dxf.group(0, "ENDTAB").group(0, "ENDSEC").group(0, "SECTION").group(2, "ENTITIES");
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
  dxf.group(0, "ENDSEC").group(0, "EOF");
  return dxf.text();
}

}  // namespace cca
