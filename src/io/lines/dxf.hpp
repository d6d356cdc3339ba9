// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cca_mrpt/geometry/arc.hpp"

namespace cca {

struct DxfLayer {
  std::string name;
  int colour;  ///< AutoCAD's number, 1 to 255; negative: the layer is switched off
};

/// Pairs of lines: a group code, and its value.
class DxfGroups {
 public:
  DxfGroups& group(int code, const std::string& value);
  DxfGroups& group(int code, int value) { return group(code, std::to_string(value)); }
  DxfGroups& number(int code, double value);
  DxfGroups& point(int code, const Eigen::Vector2d& p);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A drawing as DXF of AutoCAD 2000 (AC1015), the oldest one with units: one unit is a metre. Each
/// object has a handle and names its owner.
class Dxf {
 public:
  explicit Dxf(std::vector<DxfLayer> layers) : layers_(std::move(layers)) {}

  void line(const Eigen::Vector2d& start, const Eigen::Vector2d& end, const std::string& layer);
  void arc(const Arc& arc, const std::string& layer);
  void polyLine(const std::vector<Eigen::Vector2d>& vertices, const std::string& layer,
                bool closed = false);
  /// Text centred about a point. @param height  m. @param text  ASCII, one line.
  void text(const Eigen::Vector2d& p, double height, const std::string& text,
            const std::string& layer);

  /// The file with what was drawn so far.
  std::string file() const;

 private:
  DxfGroups& entity(const char* type, const std::string& layer, const char* kind);

  static constexpr unsigned kFirstEntity = 0x100;  ///< handles below are for the rest of the file

  std::vector<DxfLayer> layers_;
  DxfGroups entities_;
  unsigned next_ = kFirstEntity;
};

}  // namespace cca
