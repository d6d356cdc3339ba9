// SPDX-License-Identifier: BSD-3-Clause
#include "plan_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/cross.hpp"
#include "io/files/text.hpp"
#include "io/plans/plan_formats.hpp"

namespace cca {
namespace {

constexpr double kSheetMargin = 10.0, kSheetHeader = 15.0, kSheetFooter = 12.0,
                 kDimensions = 9.0;        // mm
constexpr double kLargestSide = 820.0;     // mm, of A1 with its margins
constexpr double kNarrowestSheet = 190.0;  // mm, for title and legend
constexpr double kFaceStroke = 0.45, kThin = 0.15, kOpeningStroke = 0.35;  // mm
constexpr double kSmallestText = 1.3, kLargestText = 3.4, kCaption = 2.6;  // mm
constexpr double kRectangular = 0.93;  // share of its box that a room fills whose sides are told

constexpr Colour kPlanInk{0.13, 0.15, 0.18}, kPlanSoftInk{0.40, 0.44, 0.48},
    kDoorInk{0.76, 0.30, 0.11};
constexpr Colour kOpeningInk{0.16, 0.42, 0.62}, kFurnitureFill{0.80, 0.79, 0.77};
constexpr Colour kFurnitureInk{0.55, 0.54, 0.52};
/// Pale enough for text, and unlike their neighbours in the list.
constexpr std::array<Colour, 8> kRoomFills{{{0.87, 0.92, 0.97},
                                            {0.97, 0.93, 0.82},
                                            {0.87, 0.95, 0.87},
                                            {0.96, 0.88, 0.87},
                                            {0.92, 0.89, 0.96},
                                            {0.84, 0.94, 0.94},
                                            {0.98, 0.90, 0.80},
                                            {0.93, 0.94, 0.80}}};

Eigen::AlignedBox2d boundsOfPlan(const FloorPlan& plan) {
  Eigen::AlignedBox2d box;
  for (const PlanRoom& room : plan.rooms) box.extend(boundsOf(room.outline));
  for (const PlanWall& wall : plan.walls) box.extend(wall.start).extend(wall.end);
  if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());
  return box;
}

int scaleFor(const Eigen::Vector2d& metres) {
  int scale = 50;
  for (const int next : {100, 200, 500, 1000, 2000, 5000, 10000, 100000}) {
    if (1000.0 * metres.maxCoeff() / scale <= kLargestSide) break;
    scale = next;
  }
  return scale;
}

/// m, the sides of the box along a room's longest wall; nothing where the room is no rectangle.
std::string sidesOf(const PlanRoom& room) {
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  double longest = 0.0;
  for (std::size_t k = 0; k < room.outline.size(); ++k) {
    const Eigen::Vector2d side = room.outline[(k + 1) % room.outline.size()] - room.outline[k];
    if (side.norm() <= longest) continue;
    longest = side.norm();
    along = side / longest;
  }
  Eigen::AlignedBox2d box;
  for (const auto& p : room.outline) box.extend(Eigen::Vector2d(along.dot(p), cross(along, p)));
  const Eigen::Vector2d sides = box.sizes();
  if (!room.holes.empty() || room.area < kRectangular * sides.prod()) return {};
  return formatted("%.2f", sides.maxCoeff()) + " × " + formatted("%.2f m", sides.minCoeff());
}

/// Colours so that rooms that open into each other differ, as far as eight go.
std::vector<std::size_t> coloursOf(const FloorPlan& plan) {
  std::vector<std::size_t> colour(plan.rooms.size(), kRoomFills.size());
  for (std::size_t k = 0; k < plan.rooms.size(); ++k) {
    std::array<bool, kRoomFills.size() + 1> is_taken{};
    for (const PlanOpening& opening : plan.openings) {
      const int id = plan.rooms[k].id;
      if (opening.rooms[0] != id && opening.rooms[1] != id) continue;
      const int other = opening.rooms[0] == id ? opening.rooms[1] : opening.rooms[0];
      is_taken[colour[static_cast<std::size_t>(other - 1)]] = true;
    }
    for (std::size_t shift = 0; shift < kRoomFills.size(); ++shift) {
      colour[k] = (k + shift) % kRoomFills.size();
      if (!is_taken[colour[k]]) break;
    }
  }
  return colour;
}

/// Draws a plan onto a sheet.
class Layout {
 public:
  Layout(const FloorPlan& plan, const std::string& title, const std::optional<GeoReference>& place)
      : plan_(plan) {
    const Eigen::AlignedBox2d box = boundsOfPlan(plan);
    sheet_.scale = scaleFor(box.sizes());
    mm_per_metre_ = 1000.0 / sheet_.scale;
    const Eigen::Vector2d size = mm_per_metre_ * box.sizes();
    sheet_.width = std::max(kNarrowestSheet, size.x() + 2.0 * kSheetMargin + kDimensions);
    sheet_.height = size.y() + 2.0 * kSheetMargin + kSheetHeader + kSheetFooter + kDimensions;
    corner_ = {box.min().x(), box.max().y()};
    offset_ = {0.5 * (sheet_.width - size.x() + kDimensions), kSheetHeader + kSheetMargin};
    SheetShape paper;
    paper.rings = {{{0, 0}, {sheet_.width, 0}, {sheet_.width, sheet_.height}, {0, sheet_.height}}};
    paper.fill = {1, 1, 1};
    sheet_.p_map_corner = corner_ + Eigen::Vector2d(-offset_.x(), offset_.y()) / mm_per_metre_;
    add(paper);
    layer_ = "rooms";
    drawRooms();
    layer_ = kFurnitureLayer;
    drawFurniture();
    layer_ = kWallLayer;
    drawWalls();
    layer_ = "openings";
    drawOpenings();
    layer_ = "notes";
    drawRoomTexts();
    drawDimensions(box);
    drawHeader(title);
    drawLegend();
    if (place) drawNorth(place->turn_deg * kRadiansPerDegree);
  }

  const PlanSheet& sheet() const { return sheet_; }

 private:
  Eigen::Vector2d paper(const Eigen::Vector2d& p_map) const {
    return offset_ +
           mm_per_metre_ * Eigen::Vector2d(p_map.x() - corner_.x(), corner_.y() - p_map.y());
  }
  Polygon paper(const Polygon& ring) const {
    Polygon drawn;
    for (const auto& p : ring) drawn.push_back(paper(p));
    return drawn;
  }

  SheetShape& add(SheetShape shape) {
    shape.layer = layer_;
    sheet_.shapes.push_back(std::move(shape));
    return sheet_.shapes.back();
  }
  SheetShape& line(const Polygon& points, const Colour& colour, double width) {
    SheetShape shape;
    shape.rings = {points};
    shape.is_closed = false;
    shape.stroke = colour;
    shape.stroke_width = width;
    return add(std::move(shape));
  }
  SheetShape& text(const Eigen::Vector2d& p, double size, const Colour& colour,
                   const std::string& content) {
    SheetShape shape;
    shape.rings = {{p}};
    shape.fill = colour;
    shape.text = content;
    shape.text_size = size;
    return add(std::move(shape));
  }

  void drawRooms() {
    const std::vector<std::size_t> colours = coloursOf(plan_);
    for (std::size_t k = 0; k < plan_.rooms.size(); ++k) {
      const PlanRoom& room = plan_.rooms[k];
      SheetShape shape;
      shape.rings.push_back(paper(room.outline));
      for (const Polygon& hole : room.holes) shape.rings.push_back(paper(hole));
      shape.fill = kRoomFills[colours[k]];
      shape.title = nameOf(room) + ", " + formatted("%.2f m², ", room.area) +
                    formatted("perimeter %.2f m", room.perimeter);
      if (room.open_border > 0.5)
        shape.title += formatted(", %.1f m of its border not seen", room.open_border);
      add(std::move(shape));
    }
  }

  void drawFurniture() {
    for (const PlanFurniture& piece : plan_.furniture) {
      SheetShape shape;
      shape.rings = {paper(piece.outline)};
      shape.fill = kFurnitureFill;
      shape.stroke = kFurnitureInk;
      shape.stroke_width = kThin;
      shape.title = piece.leans ? "furniture on a presumed wall" : "furniture";
      add(std::move(shape));
    }
  }

  /// A wall of two faces is filled.
  void drawWalls() {
    for (const PlanWall& wall : plan_.walls) {
      if (wall.is_presumed) {
        line({paper(wall.start), paper(wall.end)}, kPlanInk, kOpeningStroke).is_dashed = true;
        continue;
      }
      if (wall.thickness <= 0.0) {
        line({paper(wall.start), paper(wall.end)}, kPlanInk, kFaceStroke);
        continue;
      }
      SheetShape shape;
      shape.rings = {paper(outlineOf(wall))};
      shape.fill = kPlanInk;
      shape.title = formatted("wall, %.3f m thick", wall.thickness);
      add(std::move(shape));
    }
  }

  void drawOpenings() {
    for (const PlanOpening& opening : plan_.openings) {
      const bool is_door = opening.kind == OpeningKind::kDoor;
      const Colour& colour = is_door ? kDoorInk : kOpeningInk;
      SheetShape& drawn = line({paper(opening.a), paper(opening.b)}, colour, kOpeningStroke);
      drawn.is_dashed = !is_door;
      drawn.title =
          std::string(is_door ? "door" : "opening") + formatted(", %.2f m", opening.width());
      const Eigen::Vector2d way = paper(opening.b) - paper(opening.a);
      const Eigen::Vector2d across = Eigen::Vector2d(-way.y(), way.x()).normalized();
      const Eigen::Vector2d middle = 0.5 * (paper(opening.a) + paper(opening.b));
      text(middle + 2.1 * across, kSmallestText, colour, formatted("%.2f", opening.width()));
    }
  }

  void drawRoomTexts() {
    for (const PlanRoom& room : plan_.rooms) {
      const double side = mm_per_metre_ * std::sqrt(room.area);
      const double size = std::clamp(0.11 * side, kSmallestText, kLargestText);
      const std::string sides = sidesOf(room);
      const Eigen::Vector2d p = paper(room.label);
      const double up = sides.empty() ? 0.2 : 0.85;
      text(p - Eigen::Vector2d(0, up * size), size, kPlanInk, nameOf(room)).is_bold = true;
      text(p + Eigen::Vector2d(0, (1.25 - up) * size), 0.9 * size, kPlanInk,
           formatted("%.2f m²", room.area));
      if (!sides.empty())
        text(p + Eigen::Vector2d(0, (2.4 - up) * size), 0.75 * size, kPlanSoftInk, sides);
    }
  }

  void drawDimensions(const Eigen::AlignedBox2d& box) {
    const Eigen::Vector2d low = paper(box.min()), high = paper(box.max());
    const double y = low.y() + 6.0, x = low.x() - 6.0;
    dimension({low.x(), y}, {high.x(), y}, {0, -1.6}, formatted("%.2f m", box.sizes().x()));
    dimension({x, low.y()}, {x, high.y()}, {-1.0, 0}, formatted("%.2f m", box.sizes().y()));
  }

  void dimension(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& off,
                 const std::string& length) {
    const Eigen::Vector2d way = (b - a).normalized(), tick(-1.2 * way.y(), 1.2 * way.x());
    line({a, b}, kPlanSoftInk, kThin);
    for (const Eigen::Vector2d& end : {a, b}) line({end - tick, end + tick}, kPlanSoftInk, kThin);
    text(0.5 * (a + b) + off, kCaption, kPlanSoftInk, length);
  }

  void drawHeader(const std::string& title) {
    double area = 0.0;
    int doors = 0;
    for (const PlanRoom& room : plan_.rooms) area += room.area;
    for (const PlanOpening& opening : plan_.openings) doors += opening.kind == OpeningKind::kDoor;
    SheetShape& name = text({kSheetMargin, kSheetMargin + 2.0}, 4.6, kPlanInk, title);
    name.is_bold = name.is_left_aligned = true;
    const std::string numbers =
        formatted("%zu rooms, %.1f m² of floor, %d doors, %zu other openings; 1 : %d; metres",
                  plan_.rooms.size(), area, doors,
                  plan_.openings.size() - static_cast<std::size_t>(doors), sheet_.scale);
    text({kSheetMargin, kSheetMargin + 6.5}, kCaption, kPlanSoftInk, numbers).is_left_aligned =
        true;
  }

  void drawLegend() {
    const double y = sheet_.height - kSheetFooter + 3.0;
    double x = kSheetMargin;
    const auto entry = [&](SheetShape sample, const char* meaning, double width) {
      for (auto& ring : sample.rings) {
        for (auto& p : ring) p = Eigen::Vector2d(x, y) + p;
      }
      add(std::move(sample));
      text({x + 9.0, y + 0.9}, kCaption, kPlanSoftInk, meaning).is_left_aligned = true;
      x += width;
    };
    const auto box = [](const Colour& fill, double thick) {
      SheetShape shape;
      shape.rings = {{{0, -thick}, {7, -thick}, {7, thick}, {0, thick}}};
      shape.fill = fill;
      return shape;
    };
    const auto stroke = [](const Colour& colour, bool is_dashed, double width) {
      SheetShape shape;
      shape.rings = {{{0, 0}, {7, 0}}};
      shape.is_closed = false;
      shape.stroke = colour;
      shape.stroke_width = width;
      shape.is_dashed = is_dashed;
      return shape;
    };
    entry(box(kPlanInk, 1.0), "wall", 21);
    entry(stroke(kPlanInk, false, kFaceStroke), "one face seen", 34);
    entry(stroke(kPlanInk, true, kOpeningStroke), "presumed", 28);
    entry(stroke(kDoorInk, false, kOpeningStroke), "door", 21);
    entry(stroke(kOpeningInk, true, kOpeningStroke), "opening", 26);
    entry(box(kFurnitureFill, 1.0), "furniture", 28);
    const double metres = sheet_.scale <= 100 ? 1.0 : sheet_.scale <= 500 ? 5.0 : 50.0;
    line({{x, y}, {x + metres * mm_per_metre_, y}}, kPlanInk, kFaceStroke);
    text({x + metres * mm_per_metre_ + 2.0, y + 0.9}, kCaption, kPlanSoftInk,
         formatted("%g m", metres))
        .is_left_aligned = true;
  }

  /// In the upper right corner. @param turn  rad, of the map's x axis from east.
  void drawNorth(double turn) {
    const Eigen::Vector2d centre(sheet_.width - kSheetMargin - 4.0, kSheetMargin + 3.0);
    // y points down the page: a turn of the map to the left is one of north to the right.
    const Eigen::Vector2d north(std::sin(turn), -std::cos(turn)), east(-north.y(), north.x());
    const Eigen::Vector2d tip = centre + 3.5 * north, wings = centre + 1.2 * north;
    line({centre - 3.5 * north, tip}, kPlanInk, kFaceStroke);
    line({wings - east, tip, wings + east}, kPlanInk, kFaceStroke);
    text(centre - 3.2 * east + Eigen::Vector2d(0.0, 1.0), kCaption, kPlanInk, "N");
  }

  const FloorPlan& plan_;
  PlanSheet sheet_;
  double mm_per_metre_ = 10.0;
  Eigen::Vector2d corner_, offset_;
  std::string layer_ = "paper";
};

}  // namespace

Polygon outlineOf(const PlanWall& wall) {
  const Eigen::Vector2d along = (wall.end - wall.start).normalized();
  const Eigen::Vector2d half = 0.5 * wall.thickness * Eigen::Vector2d(-along.y(), along.x());
  return {wall.start + half, wall.end + half, wall.end - half, wall.start - half};
}

std::string nameOf(const PlanRoom& room) {
  return room.name.empty() ? "Room " + std::to_string(room.id) : room.name;
}

PlanSheet layOutPlan(const FloorPlan& plan, const std::string& title,
                     const std::optional<GeoReference>& place) {
  return Layout(plan, title, place).sheet();
}

}  // namespace cca
