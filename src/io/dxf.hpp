// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "cca_mrpt/geometry/arc.hpp"

namespace cca {

/// A drawing as DXF R12 (AC1009), one unit a metre: pairs of lines, a group code and its value.
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

  /// Header and line types; `layers` calls of layer() follow, then beginEntities().
  void beginLayers(int layers) {
    group(0, "SECTION").group(2, "HEADER").group(9, "$ACADVER").group(1, "AC1009");
    group(0, "ENDSEC").group(0, "SECTION").group(2, "TABLES");
    group(0, "TABLE").group(2, "LTYPE").group(70, 1).group(0, "LTYPE").group(2, "CONTINUOUS");
    group(70, 64).group(3, "Solid line").group(72, 65).group(73, 0).group(40, "0.0");
    group(0, "ENDTAB").group(0, "TABLE").group(2, "LAYER").group(70, layers);
  }

  void beginEntities() {
    group(0, "ENDTAB").group(0, "ENDSEC").group(0, "SECTION").group(2, "ENTITIES");
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

  void polyLine(const std::vector<Eigen::Vector2d>& vertices, const std::string& layer,
                bool closed = false) {
    group(0, "POLYLINE").group(8, layer).group(66, 1).point(10, Eigen::Vector2d::Zero());
    group(70, closed ? 1 : 0);
    for (const auto& vertex : vertices) group(0, "VERTEX").group(8, layer).point(10, vertex);
    group(0, "SEQEND").group(8, layer);
  }

  /// Text centred about a point. @param height  m. @param text  ASCII, one line.
  void text(const Eigen::Vector2d& p, double height, const std::string& text,
            const std::string& layer) {
    group(0, "TEXT").group(8, layer).point(10, p).number(40, height).group(1, text);
    group(72, 1).point(11, p).group(73, 2);
  }

  std::string finished() { return group(0, "ENDSEC").group(0, "EOF").text_; }

 private:
  Dxf& number(int code, double value) {
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.4f", value);
    return group(code, std::string(digits));
  }

  std::string text_;
};

}  // namespace cca
