// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "io/lines/geo_positions.hpp"
#include "io/plans/plan_formats.hpp"

namespace cca {
namespace {

using Json = nlohmann::ordered_json;

Json planRing(const Polygon& polygon, const GeoPositions& position) {
  Json points = Json::array();
  for (const auto& p : polygon) points.push_back(position(p));
  points.push_back(points.front());
  return points;
}

Json planFeature(const char* kind, int id, const char* type, Json coordinates) {
  Json found;
  found["type"] = "Feature";
  found["properties"]["kind"] = kind;
  found["properties"]["id"] = id;
  found["geometry"]["type"] = type;
  found["geometry"]["coordinates"] = std::move(coordinates);
  return found;
}

Json roomFeature(const PlanRoom& room, const GeoPositions& position) {
  Json rings = Json::array({planRing(room.outline, position)});
  for (const Polygon& hole : room.holes) rings.push_back(planRing(hole, position));
  Json found = planFeature("room", room.id, "Polygon", std::move(rings));
  Json& p = found["properties"];
  p["name"] = room.name;
  p["area_m2"] = inTenthousandths(room.area);
  p["perimeter_m"] = inTenthousandths(room.perimeter);
  p["unseen_area_m2"] = inTenthousandths(room.unseen_area);
  p["open_border_m"] = inTenthousandths(room.open_border);
  p["label_point"] = inTenthousandths(room.label);
  return found;
}

Json openingFeature(const PlanOpening& opening, const GeoPositions& position) {
  const bool is_door = opening.kind == OpeningKind::kDoor;
  Json found = planFeature(is_door ? "door" : "opening", opening.id, "LineString",
                           Json::array({position(opening.a), position(opening.b)}));
  Json& p = found["properties"];
  p["width_m"] = inTenthousandths(opening.width());
  p["rooms"] = {opening.rooms[0], opening.rooms[1]};
  if (!is_door) p["type"] = opening.kind == OpeningKind::kPassage ? "passage" : "wide";
  return found;
}

Json wallFeature(const PlanWall& wall, const GeoPositions& position) {
  Json found = planFeature("wall", wall.id, "LineString",
                           Json::array({position(wall.start), position(wall.end)}));
  Json& p = found["properties"];
  p["thickness_m"] = wall.thickness > 0.0 ? Json(inTenthousandths(wall.thickness)) : Json(nullptr);
  p["faces"] = wall.is_presumed ? 0 : wall.right.empty() ? 1 : 2;
  p["left_line_ids"] = wall.left;
  p["right_line_ids"] = wall.right;
  p["presumed"] = wall.is_presumed;
  return found;
}

Json furnitureFeature(const PlanFurniture& piece, const GeoPositions& position) {
  Json found = planFeature("furniture", piece.id, "Polygon",
                           Json::array({planRing(piece.outline, position)}));
  Json& p = found["properties"];
  p["leaning"] = piece.leans;
  p["room"] = piece.room ? Json(piece.room) : Json(nullptr);
  return found;
}

}  // namespace

std::string planGeoJson(const FloorPlan& plan, const std::optional<GeoReference>& place) {
  const GeoPositions position(place);
  std::vector<Json> all;
  for (const PlanRoom& room : plan.rooms) all.push_back(roomFeature(room, position));
  for (const PlanOpening& opening : plan.openings) all.push_back(openingFeature(opening, position));
  for (const PlanWall& wall : plan.walls) all.push_back(wallFeature(wall, position));
  for (const PlanFurniture& piece : plan.furniture) {
    all.push_back(furnitureFeature(piece, position));
  }
  return position.collection(all);
}

}  // namespace cca
