// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "cca_mrpt/io/line_formats.hpp"

namespace cca {
namespace {

/// DXF is pairs of lines: a group code, and its value. What follows is that of AutoCAD 2000
/// (AC1015), the oldest one with units: there each object has a handle and names its owner.
class Dxf {
 public:
  Dxf& group(int code, const std::string& value) {
    text_ += std::to_string(code) + "\n" + value + "\n";
    return *this;
  }

  Dxf& group(int code, int value) { return group(code, std::to_string(value)); }

  Dxf& number(int code, double value) {
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.4f", value);
    return group(code, std::string(digits));
  }

  Dxf& point(int code, const Eigen::Vector2d& p) {
    return number(code, p.x()).number(code + 10, p.y()).number(code + 20, 0.0);
  }

  static constexpr unsigned kModelSpace = 0x1F, kPaperSpace = 0x1B;
  static constexpr unsigned kFirstEntity = 0x100;  ///< handles below are for the rest of the file

  static std::string handle(unsigned number) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "%X", number);
    return digits;
  }

  void beginTable(const char* name, unsigned table, int entries) {
    group(0, "TABLE").group(2, name).group(5, handle(table)).group(330, "0");
    group(100, "AcDbSymbolTable").group(70, entries);
  }

  /// An entry of a table. @param type  as in TABLE; @param kind  its class of AutoCAD's.
  Dxf& entry(const char* type, unsigned own, unsigned table, const char* kind, const char* name) {
    group(0, type).group(5, handle(own)).group(330, handle(table));
    group(100, "AcDbSymbolTableRecord").group(100, kind);
    return group(2, name);
  }

  void line(const Eigen::Vector2d& start, const Eigen::Vector2d& end, const char* layer) {
    entity("LINE", layer, "AcDbLine").point(10, start).point(11, end);
  }

  void arc(const Arc& arc, const char* layer) {
    const double degrees = 180.0 / M_PI, start = arc.start_angle * degrees;
    const bool whole = arc.sweep >= 2.0 * M_PI;
    entity(whole ? "CIRCLE" : "ARC", layer, "AcDbCircle").point(10, arc.centre);
    number(40, arc.radius);
    if (whole) return;
    group(100, "AcDbArc").number(50, start).number(51, start + arc.sweep * degrees);
  }

  void polyLine(const std::vector<Eigen::Vector2d>& vertices, const char* layer) {
    entity("LWPOLYLINE", layer, "AcDbPolyline");
    group(90, static_cast<int>(vertices.size())).group(70, 0);
    for (const auto& vertex : vertices) number(10, vertex.x()).number(20, vertex.y());
  }

  const std::string& text() const { return text_; }

 private:
  Dxf& entity(const char* type, const char* layer, const char* kind) {
    group(0, type).group(5, handle(next_++)).group(330, handle(kModelSpace));
    return group(100, "AcDbEntity").group(8, layer).group(100, kind);
  }

  unsigned next_ = kFirstEntity;
  std::string text_;
};

constexpr int kWhite = 7, kBlue = 5, kYellow = 2, kGreen = 3;  // AutoCAD's colour numbers
constexpr int kMetres = 6;                                     // of $INSUNITS
constexpr int kMetric = 1;                                     // of $MEASUREMENT

void dxfHeader(Dxf& dxf, unsigned next_handle) {
  dxf.group(999, "Line map; drawing unit 1 m");
  dxf.group(0, "SECTION").group(2, "HEADER").group(9, "$ACADVER").group(1, "AC1015");
  dxf.group(9, "$HANDSEED").group(5, Dxf::handle(next_handle));
  dxf.group(9, "$INSUNITS").group(70, kMetres).group(9, "$MEASUREMENT").group(70, kMetric);
  dxf.group(0, "ENDSEC");
}

void dxfLayers(Dxf& dxf) {
  struct Layer {
    const char* name;
    int colour;  ///< negative: switched off
  };
  // A chain is drawn once: its lines, each with its own length, are there to be switched on.
  constexpr Layer kLayers[] = {{"0", kWhite},
                               {"POLYLINES", kWhite},
                               {"LINES", -kBlue},
                               {"ARCS", kGreen},
                               {"TRAJECTORY", kYellow}};
  constexpr unsigned kTable = 0x2, kFirst = 0x10;
  dxf.beginTable("LAYER", kTable, 5);
  unsigned own = kFirst;
  for (const Layer& layer : kLayers) {
    dxf.entry("LAYER", own++, kTable, "AcDbLayerTableRecord", layer.name);
    dxf.group(70, 0).group(62, layer.colour).group(6, "Continuous");
  }
  dxf.group(0, "ENDTAB");
}

void dxfLineTypes(Dxf& dxf) {
  constexpr unsigned kTable = 0x5;
  unsigned own = 0x15;
  dxf.beginTable("LTYPE", kTable, 3);
  for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) {
    dxf.entry("LTYPE", own++, kTable, "AcDbLinetypeTableRecord", name);
    dxf.group(70, 0).group(3, "").group(72, 65).group(73, 0).number(40, 0.0);
  }
  dxf.group(0, "ENDTAB");
}

/// Tables that each file must have, and that say nothing here.
void dxfOtherTables(Dxf& dxf) {
  dxf.beginTable("VPORT", 0x8, 0);
  dxf.group(0, "ENDTAB");
  dxf.beginTable("STYLE", 0x3, 1);
  dxf.entry("STYLE", 0x20, 0x3, "AcDbTextStyleTableRecord", "Standard");
  dxf.group(70, 0).number(40, 0.0).number(41, 1.0).number(50, 0.0).group(71, 0);
  dxf.number(42, 0.2).group(3, "txt").group(4, "").group(0, "ENDTAB");
  for (const auto& [name, table] : {std::pair{"VIEW", 0x6U}, std::pair{"UCS", 0x7U}}) {
    dxf.beginTable(name, table, 0);
    dxf.group(0, "ENDTAB");
  }
  dxf.beginTable("APPID", 0x9, 1);
  dxf.entry("APPID", 0x21, 0x9, "AcDbRegAppTableRecord", "ACAD").group(70, 0);
  dxf.group(0, "ENDTAB");
  dxf.beginTable("DIMSTYLE", 0xA, 1);
  dxf.group(100, "AcDbDimStyleTable");
  dxf.group(0, "DIMSTYLE").group(105, "22").group(330, "A").group(100, "AcDbSymbolTableRecord");
  dxf.group(100, "AcDbDimStyleTableRecord").group(2, "Standard").group(70, 0);
  dxf.group(0, "ENDTAB");
}

struct DxfSpace {
  const char* name;
  unsigned record, begin, end;
};
constexpr DxfSpace kSpaces[] = {{"*Model_Space", Dxf::kModelSpace, 0x23, 0x24},
                                {"*Paper_Space", Dxf::kPaperSpace, 0x25, 0x26}};

void dxfBlockRecords(Dxf& dxf) {
  dxf.beginTable("BLOCK_RECORD", 0x1, 2);
  for (const DxfSpace& space : kSpaces)
    dxf.entry("BLOCK_RECORD", space.record, 0x1, "AcDbBlockTableRecord", space.name);
  dxf.group(0, "ENDTAB");
}

void dxfBlocks(Dxf& dxf) {
  dxf.group(0, "SECTION").group(2, "BLOCKS");
  for (const DxfSpace& space : kSpaces) {
    const std::string owner = Dxf::handle(space.record);
    dxf.group(0, "BLOCK").group(5, Dxf::handle(space.begin)).group(330, owner);
    dxf.group(100, "AcDbEntity").group(8, "0").group(100, "AcDbBlockBegin").group(2, space.name);
    dxf.group(70, 0).point(10, Eigen::Vector2d::Zero()).group(3, space.name).group(1, "");
    dxf.group(0, "ENDBLK").group(5, Dxf::handle(space.end)).group(330, owner);
    dxf.group(100, "AcDbEntity").group(8, "0").group(100, "AcDbBlockEnd");
  }
  dxf.group(0, "ENDSEC");
}

void dxfObjects(Dxf& dxf) {
  dxf.group(0, "SECTION").group(2, "OBJECTS");
  dxf.group(0, "DICTIONARY").group(5, "C").group(330, "0").group(100, "AcDbDictionary");
  dxf.group(281, 1).group(3, "ACAD_GROUP").group(350, "D");
  dxf.group(0, "DICTIONARY").group(5, "D").group(330, "C").group(100, "AcDbDictionary");
  dxf.group(281, 1).group(0, "ENDSEC");
}

}  // namespace

std::string linesDxf(const std::vector<MapLine>& lines, const std::vector<PolyLine>& poly_lines,
                     const std::vector<Pose2>& trajectory, const std::vector<MapArc>& arcs) {
  Dxf dxf;
  const std::size_t entities = lines.size() + poly_lines.size() + arcs.size() + 1;
  dxfHeader(dxf, Dxf::kFirstEntity + static_cast<unsigned>(entities));
  dxf.group(0, "SECTION").group(2, "TABLES");
  dxfLineTypes(dxf);
  dxfLayers(dxf);
  dxfOtherTables(dxf);
  dxfBlockRecords(dxf);
  dxf.group(0, "ENDSEC");
  dxfBlocks(dxf);
  dxf.group(0, "SECTION").group(2, "ENTITIES");
  for (const PolyLine& chain : poly_lines) dxf.polyLine(chain.vertices, "POLYLINES");
  for (const MapLine& line : lines) dxf.line(line.segment.start, line.segment.end, "LINES");
  for (const MapArc& arc : arcs) dxf.arc(arc.arc, "ARCS");
  if (trajectory.size() > 1) {
    std::vector<Eigen::Vector2d> path;
    for (const Pose2& pose : trajectory) path.push_back(pose.position());
    dxf.polyLine(path, "TRAJECTORY");
  }
  dxf.group(0, "ENDSEC");
  dxfObjects(dxf);
  dxf.group(0, "EOF");
  return dxf.text();
}

}  // namespace cca
