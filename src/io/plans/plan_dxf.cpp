// SPDX-License-Identifier: BSD-3-Clause
#include "io/files/text.hpp"
#include "io/lines/dxf.hpp"
#include "io/plans/plan_formats.hpp"
#include "plan_sheet.hpp"

namespace cca {
namespace {

constexpr int kAciRed = 1, kAciYellow = 2, kAciGreen = 3, kAciCyan = 4, kAciMagenta = 6,
              kAciWhite = 7, kAciGrey = 8;
constexpr double kTextHeight = 0.2;  // m

Dxf planDrawing() {
  return Dxf({{"A-WALL", kAciWhite},
              {"A-WALL-PRSM", kAciGrey},
              {"A-DOOR", kAciRed},
              {"A-OPNG", kAciCyan},
              {"A-AREA", kAciGreen},
              {"A-AREA-IDEN", kAciYellow},
              {"A-FURN", kAciMagenta}});
}

void addWall(Dxf& dxf, const PlanWall& wall) {
  if (wall.thickness <= 0.0) {
    dxf.line(wall.start, wall.end, wall.is_presumed ? "A-WALL-PRSM" : "A-WALL");
  } else {
    dxf.polyLine(outlineOf(wall), "A-WALL", true);
  }
}

/// AutoCAD 2000 is ASCII: other characters as AutoCAD writes them.
std::string inDxf(const std::string& utf8) {
  std::string text;
  for (std::size_t k = 0; k < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[k]);
    const std::size_t bytes = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    if (bytes == 1) {
      if (lead >= 0x20) text += utf8[k];
    } else if (k + bytes <= utf8.size()) {
      unsigned code = lead & (0xFFU >> (bytes + 1));
      for (std::size_t i = 1; i < bytes; ++i)
        code = code << 6 | (static_cast<unsigned char>(utf8[k + i]) & 0x3FU);
      text += formatted("\\U+%04X", code);
    }
    k += bytes;
  }
  return text;
}

void addRoom(Dxf& dxf, const PlanRoom& room) {
  dxf.polyLine(room.outline, "A-AREA", true);
  for (const Polygon& hole : room.holes) dxf.polyLine(hole, "A-AREA", true);
  const Eigen::Vector2d down(0.0, -1.4 * kTextHeight);
  dxf.text(room.label, kTextHeight, inDxf(nameOf(room)), "A-AREA-IDEN");
  dxf.text(room.label + down, kTextHeight, formatted("%.2f m2", room.area), "A-AREA-IDEN");
}

}  // namespace

std::string planDxf(const FloorPlan& plan) {
  Dxf dxf = planDrawing();
  for (const PlanRoom& room : plan.rooms) addRoom(dxf, room);
  for (const PlanFurniture& piece : plan.furniture) dxf.polyLine(piece.outline, "A-FURN", true);
  for (const PlanWall& wall : plan.walls) addWall(dxf, wall);
  for (const PlanOpening& opening : plan.openings)
    dxf.line(opening.a, opening.b, opening.kind == OpeningKind::kDoor ? "A-DOOR" : "A-OPNG");
  return dxf.file();
}

}  // namespace cca
