// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/floor_plan/floor_plan.hpp"

#include <algorithm>
#include <cmath>

#include "floor_plan/distance_transform.hpp"
#include "floor_plan/furniture.hpp"
#include "floor_plan/jambs.hpp"
#include "floor_plan/main_directions.hpp"
#include "floor_plan/passages.hpp"
#include "floor_plan/polygon_measures.hpp"
#include "floor_plan/region_outline.hpp"
#include "floor_plan/room_outline.hpp"
#include "floor_plan/room_regions.hpp"
#include "floor_plan/structure.hpp"
#include "floor_plan/walls.hpp"
#include "geometry/distance_to_segment.hpp"

namespace cca {
namespace {

constexpr int kMargin = 2;              // cells around what is known
constexpr double kOpening = 2.5;        // m, the widest of passages: a double door and some
constexpr double kSmallestHole = 0.05;  // m^2: a pillar of 22 cm is one
constexpr double kBeyondGrid = 1.0;     // m, ends of lines overshoot what is known by less

std::vector<Passage> candidatePassages(const Structure& structure, const Raster<float>& clearance,
                                       const std::vector<MapLine>& lines) {
  const std::vector<WallEnd> ends = freeWallEnds(structure.solid, lines);
  std::vector<Passage> gaps = gapsInWalls(structure.solid, lines);
  for (const Passage& gap : gapsBetweenEnds(structure.solid, ends)) gaps.push_back(gap);
  for (const Passage& gap : gapsAtCorners(structure.solid, lines)) gaps.push_back(gap);
  std::vector<Passage> narrow = narrowings(structure.solid, clearance, ends);
  for (std::vector<Passage>* found : {&gaps, &narrow}) {
    for (Passage& passage : *found) {
      // In the line that it was found in: beside furniture its middle lies off the wall.
      passage.support = wallSupport(passage, lines);
      passage = centred(structure.solid, passage);
    }
  }
  return joinPassages(std::move(gaps), narrow);
}

/// Cells that no beam reached, and no line crosses.
Mask hiddenFloor(const OccupancyRaster& grid, const std::vector<MapLine>& lines) {
  Mask hidden = grid.alike(std::uint8_t{0});
  for (std::size_t k = 0; k < grid.values.size(); ++k)
    hidden.values[k] = grid.values[k] == Occupancy::kUnknown;
  for (const MapLine& line : lines) {
    for (const Cell c : cellsAlong(hidden, line.segment.start, line.segment.end)) hidden[c] = 0;
  }
  return hidden;
}

OpeningKind kindOf(double width) {
  if (width <= PassageTuning{}.widest_door) return OpeningKind::kDoor;
  return width <= kOpening ? OpeningKind::kPassage : OpeningKind::kWide;
}

std::vector<PlanOpening> openingsOf(const RoomRegions& regions) {
  std::vector<PlanOpening> openings;
  for (const RoomBorder& border : regions.borders) {
    PlanOpening opening;
    opening.id = static_cast<int>(openings.size()) + 1;
    opening.kind = kindOf(border.passage.width());
    opening.a = border.passage.a;
    opening.b = border.passage.b;
    opening.rooms = {border.rooms[0] + 1, border.rooms[1] + 1};
    openings.push_back(opening);
  }
  return openings;
}

/// The openings of one room, as segments.
std::vector<Passage> passagesOf(const RoomRegions& regions, int label) {
  std::vector<Passage> passages;
  for (const RoomBorder& border : regions.borders) {
    if (border.rooms[0] == label || border.rooms[1] == label) passages.push_back(border.passage);
  }
  return passages;
}

/// The outline and the holes of a room: along lines in main directions, or else as they are, or
/// else straightened, or else along cells.
void drawRoom(const Raster<int>& labels, const RegionOutline& border,
              const std::vector<MapLine>& straight, const std::vector<MapLine>& lines,
              const std::vector<Passage>& openings, PlanRoom& room) {
  const auto largest = std::max_element(
      border.outlines.begin(), border.outlines.end(),
      [](const Polygon& a, const Polygon& b) { return signedArea(a) < signedArea(b); });
  if (largest == border.outlines.end()) return;
  for (const int attempt : {0, 1, 2, 3}) {
    const auto drawn = [&](const Polygon& chain) {
      if (attempt > 1)
        return straightened(labels, chain, attempt == 2 ? OutlineTuning{}.tolerance : 0.0);
      return withoutSmallLoops(
          outlineAlongLines(labels, chain, attempt == 0 ? straight : lines, openings));
    };
    room.outline = drawn(*largest);
    room.holes.clear();
    for (const Polygon& chain : border.holes) {
      Polygon hole = drawn(chain);
      if (-signedArea(hole) > kSmallestHole) room.holes.push_back(std::move(hole));
    }
    if (isValidPolygon(room.outline, room.holes)) return;
  }
}

/// Cells that a beam ended in or a line crosses: what borders on none of them borders on the
/// unknown.
Mask obstaclesSeen(const OccupancyRaster& grid, const std::vector<MapLine>& lines) {
  Mask seen = grid.alike(std::uint8_t{0});
  for (std::size_t k = 0; k < grid.values.size(); ++k)
    seen.values[k] = grid.values[k] == Occupancy::kOccupied;
  for (const MapLine& line : lines) {
    for (const Cell c : cellsAlong(seen, line.segment.start, line.segment.end)) seen[c] = 1;
  }
  return seen;
}

/// m of a room's border with cells beyond that are unknown, and no obstacle within two cells.
double openBorder(const Mask& obstacles, const Raster<int>& labels, const RegionOutline& border) {
  double length = 0.0;
  for (const Polygon& chain : border.outlines) {
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const Eigen::Vector2d side = chain[(k + 1) % chain.size()] - chain[k];
      const Eigen::Vector2d beyond = chain[k] + 0.5 * side + Eigen::Vector2d(side.y(), -side.x());
      const Cell c = cellAt(beyond);
      if (labels.at(c, -1) >= 0) continue;
      bool is_seen = false;
      for (int y = -2; y <= 2 && !is_seen; ++y) {
        for (int x = -2; x <= 2 && !is_seen; ++x) is_seen = obstacles.at(c + Cell{x, y}, 0);
      }
      if (!is_seen) length += labels.resolution;
    }
  }
  return length;
}

PlanWall presumedWall(const PlanFurniture& piece) {
  PlanWall wall;
  wall.start = piece.outline.back();
  wall.end = piece.outline.front();
  wall.is_presumed = true;
  return wall;
}

/// Cuts what leans on the walls of a room from its outline, where that leaves it valid.
void takeLeaning(const std::vector<Passage>& openings, PlanRoom& room, FloorPlan& plan) {
  Polygon outline = room.outline;
  std::vector<PlanFurniture> leaning = cutLeaning(outline, plan.room_of, openings);
  if (leaning.empty() || !isValidPolygon(outline, room.holes)) return;
  room.outline = outline;
  for (PlanFurniture& piece : leaning) {
    piece.room = room.id;
    room.unseen_area += areaOf(piece.outline, {});
    plan.walls.push_back(presumedWall(piece));
    plan.furniture.push_back(std::move(piece));
  }
}

/// Where each room has the most free floor around; and the area of it that no beam crossed.
void noteCells(const OccupancyRaster& grid, const Mask& open, const Raster<int>& labels,
               std::vector<PlanRoom>& rooms) {
  Mask ends = open;  // an opening ends a room as a wall does: who is sent there is to be inside
  for (std::size_t k = 0; k < ends.values.size(); ++k) {
    const Cell c = labels.cell(k);
    const bool is_inside = std::all_of(kNeighbours.begin(), kNeighbours.end(), [&](const Cell& n) {
      return labels.at(c + n, -1) == labels.values[k];
    });
    ends.values[k] = open.values[k] == 0 || !is_inside;
  }
  const Raster<float> clearance = distanceTransform(ends);
  std::vector<float> widest(rooms.size(), -1.0F);
  const double cell = grid.resolution * grid.resolution;
  for (std::size_t k = 0; k < labels.values.size(); ++k) {
    if (labels.values[k] < 0) continue;
    const auto room = static_cast<std::size_t>(labels.values[k]);
    if (grid.values[k] == Occupancy::kUnknown) rooms[room].unseen_area += cell;
    if (clearance.values[k] <= widest[room]) continue;
    widest[room] = clearance.values[k];
    rooms[room].label = labels.centreOf(labels.cell(k));
  }
}

void numberAll(FloorPlan& plan) {
  int id = 0;
  for (PlanWall& wall : plan.walls) wall.id = ++id;
  id = 0;
  for (PlanFurniture& piece : plan.furniture) {
    piece.id = ++id;
    if (piece.room == 0) piece.room = roomAt(plan, boundsOf(piece.outline).center());
  }
}

/// Whether a line is a side of a piece of furniture: its middle lies on one, and it is no longer.
bool isSideOf(const LineSegment& line, const PlanFurniture& piece) {
  const double on_side = OutlineTuning{}.tolerance;
  const Eigen::Vector2d middle = 0.5 * (line.start + line.end);
  for (std::size_t k = 0; k + 1 < piece.outline.size(); ++k) {
    const Eigen::Vector2d &a = piece.outline[k], &b = piece.outline[k + 1];
    if (distanceToSegment(a, b, middle) < on_side && line.length() < (b - a).norm() + 2.0 * on_side)
      return true;
  }
  return false;
}

/// The lines without those of what leans on walls: these are no walls.
std::vector<MapLine> withoutLeaning(const std::vector<MapLine>& lines, const FloorPlan& plan) {
  std::vector<MapLine> walls;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(walls), [&](const MapLine& line) {
    return std::none_of(plan.furniture.begin(), plan.furniture.end(), [&](const PlanFurniture& p) {
      return p.leans && isSideOf(line.segment, p);
    });
  });
  return walls;
}

/// The part of each wall's line that lies in the box [Liang & Barsky 1984]; lines outside of it are
/// left out, as are dotted ones. Work along a line is then bounded by the grid.
std::vector<MapLine> linesWithin(const Eigen::AlignedBox2d& box,
                                 const std::vector<MapLine>& lines) {
  std::vector<MapLine> within;
  for (const MapLine& line : lines) {
    if (line.kind != LineKind::kWall) continue;
    const Eigen::Vector2d start = line.segment.start, way = line.segment.end - start;
    double from = 0.0, to = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      const double low = box.min()[axis] - start[axis], high = box.max()[axis] - start[axis];
      if (way[axis] == 0.0) {
        if (low > 0.0 || high < 0.0) to = -1.0;
        continue;
      }
      from = std::max(from, std::min(low / way[axis], high / way[axis]));
      to = std::min(to, std::max(low / way[axis], high / way[axis]));
    }
    if (from > to) continue;
    within.push_back(line);
    if (from > 0.0) within.back().segment.start = start + from * way;
    if (to < 1.0) within.back().segment.end = start + to * way;
  }
  return within;
}

/// The faces of the building: lines of furniture bound no room.
std::vector<MapLine> facesOf(const Mask& solid, const std::vector<MapLine>& lines) {
  std::vector<MapLine> faces;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(faces),
               [&](const MapLine& line) { return standsOn(solid, line.segment); });
  return faces;
}

}  // namespace

FloorPlan floorPlan(const OccupancyRaster& whole, const std::vector<MapLine>& map_lines) {
  FloorPlan plan;
  const OccupancyRaster grid = cropToKnown(whole, kMargin);
  plan.room_of = grid.alike(0);
  if (grid.values.empty()) return plan;
  const Eigen::Vector2d beyond = Eigen::Vector2d::Constant(kBeyondGrid);
  const Eigen::Vector2d size = grid.resolution * Eigen::Vector2d(grid.columns, grid.rows);
  const std::vector<MapLine> all_lines =
      linesWithin({grid.origin - beyond, grid.origin + size + beyond}, map_lines);
  const Structure structure = tellStructure(grid, all_lines);
  const std::vector<MapLine> lines = facesOf(structure.solid, all_lines);
  // Drawn by; where rooms part, cells and lines are to agree.
  const std::vector<MapLine> straight = alongMainDirections(lines, mainDirections(lines));
  const Raster<float> clearance = distanceTransform(structure.solid);
  RoomRegions regions = partitionIntoRooms(spaceForRooms(structure, clearance), clearance,
                                           hiddenFloor(grid, all_lines),
                                           candidatePassages(structure, clearance, lines));
  for (RoomBorder& border : regions.borders)
    border.passage = withJambsOfLines(border.passage, lines);
  plan.openings = openingsOf(regions);
  for (std::size_t k = 0; k < regions.labels.values.size(); ++k)
    plan.room_of.values[k] = regions.labels.values[k] + 1;
  plan.furniture = freeStanding(structure.furniture);
  plan.rooms.resize(static_cast<std::size_t>(regions.count));
  noteCells(grid, structure.open, regions.labels, plan.rooms);
  const std::vector<RegionOutline> borders = outlinesOfRegions(regions.labels, regions.count);
  const Mask obstacles = obstaclesSeen(grid, lines);
  for (std::size_t k = 0; k < plan.rooms.size(); ++k) {
    PlanRoom& room = plan.rooms[k];
    room.id = static_cast<int>(k) + 1;
    const std::vector<Passage> openings = passagesOf(regions, static_cast<int>(k));
    drawRoom(regions.labels, borders[k], straight, lines, openings, room);
    takeLeaning(openings, room, plan);
    room.area = areaOf(room.outline, room.holes);
    room.perimeter = perimeterOf(room.outline, room.holes);
    room.open_border = openBorder(obstacles, regions.labels, borders[k]);
  }
  std::vector<PlanWall> walls = wallsOfLines(structure.solid, withoutLeaning(straight, plan));
  plan.walls.insert(plan.walls.begin(), walls.begin(), walls.end());
  numberAll(plan);
  return plan;
}

int roomAt(const FloorPlan& plan, const Eigen::Vector2d& p) {
  for (const PlanRoom& room : plan.rooms) {
    if (!isInside(room.outline, p)) continue;
    if (std::none_of(room.holes.begin(), room.holes.end(),
                     [&](const Polygon& hole) { return isInside(hole, p); }))
      return room.id;
  }
  return 0;
}

}  // namespace cca
