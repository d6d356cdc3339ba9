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
  /// Pairs of lines: a group code, and its value.
  class Groups {
   public:
    Groups& group(int code, const std::string& value);
    Groups& group(int code, int value) { return group(code, std::to_string(value)); }
    Groups& number(int code, double value);
    Groups& point(int code, const Eigen::Vector2d& p);
    void beginTable(const char* name, unsigned table, std::size_t entries);
    /// @param type  as in TABLE. @param kind  its class of AutoCAD's.
    Groups& entry(const char* type, unsigned own, unsigned table, const char* kind,
                  const std::string& name);
    void endTable() { group(0, "ENDTAB"); }
    const std::string& text() const { return text_; }

   private:
    std::string text_;
  };

  Groups& entity(const char* type, const std::string& layer, const char* kind);
  static std::string handle(unsigned number);
  static void addLineTypes(Groups& groups);
  static void addOtherTables(Groups& groups);
  static void addBlockRecords(Groups& groups);
  static void addBlocks(Groups& groups);
  static void addObjects(Groups& groups);
  void addHeader(Groups& groups) const;
  void addLayers(Groups& groups) const;

  static constexpr unsigned kModelSpace = 0x1F, kPaperSpace = 0x1B;
  static constexpr unsigned kFirstEntity = 0x100;  ///< handles below are for the rest of the file

  std::vector<DxfLayer> layers_;
  Groups entities_;
  unsigned next_ = kFirstEntity;
};

}  // namespace cca
