// SPDX-License-Identifier: BSD-3-Clause
#include "dxf.hpp"

#include <cmath>
#include <utility>

#include "io/files/text.hpp"

namespace cca {
namespace {

constexpr int kMetres = 6;  // of $INSUNITS
constexpr int kMetric = 1;  // of $MEASUREMENT

struct DxfSpace {
  const char* name;
  unsigned record, begin, end;  // handles
};
constexpr DxfSpace kDxfSpaces[] = {{"*Model_Space", 0x1F, 0x23, 0x24},
                                   {"*Paper_Space", 0x1B, 0x25, 0x26}};

std::string handle(unsigned number) { return formatted("%X", number); }

void beginTable(DxfGroups& groups, const char* name, unsigned table, std::size_t entries) {
  groups.group(0, "TABLE").group(2, name).group(5, handle(table)).group(330, "0");
  groups.group(100, "AcDbSymbolTable").group(70, static_cast<int>(entries));
}

void endTable(DxfGroups& groups) { groups.group(0, "ENDTAB"); }

/// @param type  as in TABLE. @param kind  its class of AutoCAD's.
DxfGroups& entry(DxfGroups& groups, const char* type, unsigned own, unsigned table,
                 const char* kind, const std::string& name) {
  groups.group(0, type).group(5, handle(own)).group(330, handle(table));
  groups.group(100, "AcDbSymbolTableRecord").group(100, kind);
  return groups.group(2, name);
}

void addHeader(DxfGroups& groups, unsigned next_handle) {
  groups.group(0, "SECTION").group(2, "HEADER").group(9, "$ACADVER").group(1, "AC1015");
  groups.group(9, "$HANDSEED").group(5, handle(next_handle));
  groups.group(9, "$INSUNITS").group(70, kMetres).group(9, "$MEASUREMENT").group(70, kMetric);
  groups.group(0, "ENDSEC");
}

void addLayers(DxfGroups& groups, const std::vector<DxfLayer>& layers) {
  constexpr unsigned kTable = 0x2, kFirst = 0x60;
  constexpr int kWhite = 7;
  beginTable(groups, "LAYER", kTable, layers.size() + 1);
  unsigned own = kFirst;
  const auto add = [&](const std::string& name, int colour) {
    entry(groups, "LAYER", own++, kTable, "AcDbLayerTableRecord", name);
    groups.group(70, 0).group(62, colour).group(6, "Continuous");
  };
  add("0", kWhite);
  for (const DxfLayer& layer : layers) add(layer.name, layer.colour);
  endTable(groups);
}

void addLineTypes(DxfGroups& groups) {
  constexpr unsigned kTable = 0x5;
  unsigned own = 0x15;
  beginTable(groups, "LTYPE", kTable, 3);
  for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) {
    entry(groups, "LTYPE", own++, kTable, "AcDbLinetypeTableRecord", name);
    groups.group(70, 0).group(3, "").group(72, 65).group(73, 0).number(40, 0.0);
  }
  endTable(groups);
}

/// Tables that each file must have, and that say nothing here.
void addOtherTables(DxfGroups& groups) {
  beginTable(groups, "VPORT", 0x8, 0);
  endTable(groups);
  beginTable(groups, "STYLE", 0x3, 1);
  entry(groups, "STYLE", 0x20, 0x3, "AcDbTextStyleTableRecord", "Standard");
  groups.group(70, 0).number(40, 0.0).number(41, 1.0).number(50, 0.0).group(71, 0);
  groups.number(42, 0.2).group(3, "txt").group(4, "");
  endTable(groups);
  for (const auto& [name, table] : {std::pair{"VIEW", 0x6U}, std::pair{"UCS", 0x7U}}) {
    beginTable(groups, name, table, 0);
    endTable(groups);
  }
  beginTable(groups, "APPID", 0x9, 1);
  entry(groups, "APPID", 0x21, 0x9, "AcDbRegAppTableRecord", "ACAD").group(70, 0);
  endTable(groups);
  beginTable(groups, "DIMSTYLE", 0xA, 1);
  groups.group(100, "AcDbDimStyleTable");
  groups.group(0, "DIMSTYLE").group(105, "22").group(330, "A").group(100, "AcDbSymbolTableRecord");
  groups.group(100, "AcDbDimStyleTableRecord").group(2, "Standard").group(70, 0);
  endTable(groups);
}

void addBlockRecords(DxfGroups& groups) {
  beginTable(groups, "BLOCK_RECORD", 0x1, 2);
  for (const DxfSpace& space : kDxfSpaces) {
    entry(groups, "BLOCK_RECORD", space.record, 0x1, "AcDbBlockTableRecord", space.name);
  }
  endTable(groups);
}

void addBlocks(DxfGroups& groups) {
  groups.group(0, "SECTION").group(2, "BLOCKS");
  for (const DxfSpace& space : kDxfSpaces) {
    const std::string owner = handle(space.record);
    groups.group(0, "BLOCK").group(5, handle(space.begin)).group(330, owner);
    groups.group(100, "AcDbEntity").group(8, "0").group(100, "AcDbBlockBegin");
    groups.group(2, space.name).group(70, 0).point(10, Eigen::Vector2d::Zero());
    groups.group(3, space.name).group(1, "");
    groups.group(0, "ENDBLK").group(5, handle(space.end)).group(330, owner);
    groups.group(100, "AcDbEntity").group(8, "0").group(100, "AcDbBlockEnd");
  }
  groups.group(0, "ENDSEC");
}

void addObjects(DxfGroups& groups) {
  groups.group(0, "SECTION").group(2, "OBJECTS");
  groups.group(0, "DICTIONARY").group(5, "C").group(330, "0").group(100, "AcDbDictionary");
  groups.group(281, 1).group(3, "ACAD_GROUP").group(350, "D");
  groups.group(0, "DICTIONARY").group(5, "D").group(330, "C").group(100, "AcDbDictionary");
  groups.group(281, 1).group(0, "ENDSEC");
}

}  // namespace

DxfGroups& DxfGroups::group(int code, const std::string& value) {
  text_ += std::to_string(code) + "\n" + value + "\n";
  return *this;
}

DxfGroups& DxfGroups::number(int code, double value) {
  return group(code, formatted("%.4f", value));
}

DxfGroups& DxfGroups::point(int code, const Eigen::Vector2d& p) {
  return number(code, p.x()).number(code + 10, p.y()).number(code + 20, 0.0);
}

DxfGroups& Dxf::entity(const char* type, const std::string& layer, const char* kind) {
  entities_.group(0, type).group(5, handle(next_++)).group(330, handle(kDxfSpaces[0].record));
  return entities_.group(100, "AcDbEntity").group(8, layer).group(100, kind);
}

void Dxf::line(const Eigen::Vector2d& start, const Eigen::Vector2d& end, const std::string& layer) {
  entity("LINE", layer, "AcDbLine").point(10, start).point(11, end);
}

void Dxf::arc(const Arc& arc, const std::string& layer) {
  const double start = arc.start_angle * kDegreesPerRadian;
  const bool whole = arc.sweep >= 2.0 * M_PI;
  entity(whole ? "CIRCLE" : "ARC", layer, "AcDbCircle").point(10, arc.centre);
  entities_.number(40, arc.radius);
  if (whole) return;
  entities_.group(100, "AcDbArc")
      .number(50, start)
      .number(51, start + arc.sweep * kDegreesPerRadian);
}

void Dxf::polyLine(const std::vector<Eigen::Vector2d>& vertices, const std::string& layer,
                   bool closed) {
  entity("LWPOLYLINE", layer, "AcDbPolyline");
  entities_.group(90, static_cast<int>(vertices.size())).group(70, closed ? 1 : 0);
  for (const auto& vertex : vertices) entities_.number(10, vertex.x()).number(20, vertex.y());
}

void Dxf::text(const Eigen::Vector2d& p, double height, const std::string& text,
               const std::string& layer) {
  entity("TEXT", layer, "AcDbText").point(10, p);
  entities_.number(40, height).group(1, text).group(72, 1).point(11, p);
  entities_.group(100, "AcDbText").group(73, 2);
}

std::string Dxf::file() const {
  DxfGroups groups;
  addHeader(groups, next_);
  groups.group(0, "SECTION").group(2, "TABLES");
  addLineTypes(groups);
  addLayers(groups, layers_);
  addOtherTables(groups);
  addBlockRecords(groups);
  groups.group(0, "ENDSEC");
  addBlocks(groups);
  groups.group(0, "SECTION").group(2, "ENTITIES");
  DxfGroups end;
  end.group(0, "ENDSEC");
  addObjects(end);
  end.group(0, "EOF");
  return groups.text() + entities_.text() + end.text();
}

}  // namespace cca
