// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/plans/plan_formats.hpp"

namespace cca {
namespace {

using Json = nlohmann::ordered_json;

double inTenthsOfMm(double metres) { return std::round(1e4 * metres) / 1e4; }

Json planPoint(const Eigen::Vector2d& p) { return {inTenthsOfMm(p.x()), inTenthsOfMm(p.y())}; }

Json planRing(const Polygon& polygon) {
  Json points = Json::array();
  for (const auto& p : polygon) points.push_back(planPoint(p));
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

Json roomFeature(const PlanRoom& room) {
  Json rings = Json::array({planRing(room.outline)});
  for (const Polygon& hole : room.holes) rings.push_back(planRing(hole));
  Json found = planFeature("room", room.id, "Polygon", std::move(rings));
  Json& p = found["properties"];
  p["name"] = room.name;
  p["area_m2"] = inTenthsOfMm(room.area);
  p["perimeter_m"] = inTenthsOfMm(room.perimeter);
  p["unseen_area_m2"] = inTenthsOfMm(room.unseen_area);
  p["open_border_m"] = inTenthsOfMm(room.open_border);
  p["label_point"] = planPoint(room.label);
  return found;
}

Json openingFeature(const PlanOpening& opening) {
  const bool is_door = opening.kind == OpeningKind::kDoor;
  Json found = planFeature(is_door ? "door" : "opening", opening.id, "LineString",
                           Json::array({planPoint(opening.a), planPoint(opening.b)}));
  Json& p = found["properties"];
  p["width_m"] = inTenthsOfMm(opening.width());
  p["rooms"] = {opening.rooms[0], opening.rooms[1]};
  if (!is_door) p["type"] = opening.kind == OpeningKind::kPassage ? "passage" : "wide";
  return found;
}

Json wallFeature(const PlanWall& wall) {
  Json found = planFeature("wall", wall.id, "LineString",
                           Json::array({planPoint(wall.start), planPoint(wall.end)}));
  Json& p = found["properties"];
  p["thickness_m"] = wall.thickness > 0.0 ? Json(inTenthsOfMm(wall.thickness)) : Json(nullptr);
  p["faces"] = wall.is_presumed ? 0 : wall.right.empty() ? 1 : 2;
  p["left_line_ids"] = wall.left;
  p["right_line_ids"] = wall.right;
  p["presumed"] = wall.is_presumed;
  return found;
}

Json furnitureFeature(const PlanFurniture& piece) {
  Json found =
      planFeature("furniture", piece.id, "Polygon", Json::array({planRing(piece.outline)}));
  Json& p = found["properties"];
  p["leaning"] = piece.leans;
  p["room"] = piece.room ? Json(piece.room) : Json(nullptr);
  return found;
}

}  // namespace

std::string planGeoJson(const FloorPlan& plan) {
  std::string text = "{\"type\": \"FeatureCollection\", \"features\": [";
  const char* separator = "\n";
  const auto put = [&](const Json& found) {
    text += separator + found.dump(-1, ' ', false, Json::error_handler_t::replace);
    separator = ",\n";
  };
  for (const PlanRoom& room : plan.rooms) put(roomFeature(room));
  for (const PlanOpening& opening : plan.openings) put(openingFeature(opening));
  for (const PlanWall& wall : plan.walls) put(wallFeature(wall));
  for (const PlanFurniture& piece : plan.furniture) put(furnitureFeature(piece));
  return text + "\n]}\n";
}

}  // namespace cca
