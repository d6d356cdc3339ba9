// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/structure.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "floor_plan/distance_transform.hpp"
#include "floor_plan/room_regions.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kBeyondWall = 0.15;  // m; lines end that much beyond their wall
constexpr double kOpposite =
    0.5;                   // cosine; walls on two sides run to 60 degrees against each other
constexpr int kThick = 1;  // cells to each side of a line, that noise fills
constexpr double kTouching = kThick + 2.0;  // cells from a line to the centre of what touches these
constexpr double kIntoCorner = 1.42;        // a disc's radius to the corner that it fits into

/// m, the longest line of each component.
std::vector<double> longestLines(const Components& parts, const std::vector<MapLine>& lines) {
  std::vector<double> longest(parts.sizes.size(), 0.0);
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    const double length = s.length();
    for (const Cell c : cellsAlong(parts.labels, s.start, s.end)) {
      if (parts.labels[c] < 0) continue;  // of what stands in front of a wall
      double& known = longest[static_cast<std::size_t>(parts.labels[c])];
      known = std::max(known, length);
    }
  }
  return longest;
}

/// m, the longer side of each component's box.
std::vector<double> extents(const Components& parts) {
  std::vector<double> extent;
  for (std::size_t k = 0; k < parts.sizes.size(); ++k) {
    const Cell low = parts.lowest[k], high = parts.highest[k];
    extent.push_back(parts.labels.resolution * (1 + std::max(high.x - low.x, high.y - low.y)));
  }
  return extent;
}

/// The islands that a wall's line meets beyond its end, before it meets the building again.
std::set<std::size_t> metBeyond(const Components& parts, const std::vector<char>& is_island,
                                const Eigen::Vector2d& end, const Eigen::Vector2d& direction,
                                double farthest) {
  const double step = 0.5 * parts.labels.resolution;
  std::set<std::size_t> met;
  bool has_left_wall = false;
  for (double s = -kBeyondWall; s <= farthest; s += step) {
    const int label = parts.labels.at(parts.labels.cellOf(end + s * direction), -1);
    const auto part = static_cast<std::size_t>(label);
    const bool is_building = label >= 0 && !is_island[part];
    if (is_building && has_left_wall) break;
    has_left_wall = has_left_wall || !is_building;
    if (label >= 0 && !is_building) met.insert(part);
  }
  return met;
}

/// Islands that walls lead up to from two sides.
std::vector<char> betweenWalls(const Components& parts, const std::vector<char>& is_island,
                               const std::vector<MapLine>& lines, const StructureTuning& tuning) {
  std::vector<std::vector<Eigen::Vector2d>> met(parts.sizes.size());
  std::vector<char> is_between(parts.sizes.size(), 0);
  const PassageTuning passages;
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    if (s.length() < tuning.pillar) continue;
    const Eigen::Vector2d along = s.direction(), into_wall(along.y(), -along.x());
    for (const bool at_end : {false, true}) {
      const Eigen::Vector2d direction = at_end ? along : Eigen::Vector2d(-along);
      const Eigen::Vector2d end = (at_end ? s.end : s.start) + passages.depth * into_wall;
      for (const std::size_t k : metBeyond(parts, is_island, end, direction, passages.widest)) {
        for (const Eigen::Vector2d& other : met[k])
          is_between[k] = is_between[k] || other.dot(direction) < -kOpposite;
        met[k].push_back(direction);
      }
    }
  }
  return is_between;
}

/// What stands free and is no part of the building, by component.
std::vector<char> furnitureAmong(const Components& parts, const std::vector<MapLine>& lines,
                                 const StructureTuning& tuning) {
  const std::vector<double> longest = longestLines(parts, lines), extent = extents(parts);
  const int outside = parts.labels.at({0, 0}, -1);
  std::vector<char> is_island(parts.sizes.size(), 0);
  for (std::size_t k = 0; k < is_island.size(); ++k) {
    is_island[k] =
        static_cast<int>(k) != outside &&
        (extent[k] <= tuning.pillar || (extent[k] <= tuning.group && longest[k] < tuning.pillar));
  }
  const std::vector<char> is_between = betweenWalls(parts, is_island, lines, tuning);
  std::vector<char> is_furniture = is_island;
  for (std::size_t k = 0; k < is_island.size(); ++k) {
    const bool is_pillar = extent[k] >= tuning.thinnest_pillar && extent[k] <= tuning.pillar;
    if (is_between[k] && is_pillar) is_furniture[k] = 0;
  }
  return is_furniture;
}

/// Whether an island touches a wall on its viewer's side, and the wall's line goes on behind it to
/// both sides, by more than lines err. What is thinner along the wall may be the stub of another
/// one.
bool isInFrontOf(const LineSegment& wall, const std::vector<Eigen::Vector2d>& island,
                 double resolution, double thinnest) {
  const double beside = PassageTuning{}.end_error;
  const Eigen::Vector2d along = wall.direction();
  Eigen::AlignedBox2d box;  // along the wall, and away from it
  for (const Eigen::Vector2d& p : island) {
    const Eigen::Vector2d off = p - wall.start;
    box.extend(Eigen::Vector2d(off.dot(along), cross(along, off)));
  }
  return box.min().y() > 0.0 && box.min().y() < kTouching * resolution &&
         box.sizes().x() + resolution >= thinnest && box.min().x() > beside &&
         box.max().x() < wall.length() - beside;
}

/// What stands in front of walls: islands up to `pillar` once the cells on the walls' lines are
/// left out.
Mask inFrontOfWalls(const Mask& blocked, const std::vector<MapLine>& lines,
                    const StructureTuning& tuning) {
  std::vector<LineSegment> walls;
  Mask rest = blocked;
  for (const MapLine& line : lines) {
    if (line.segment.length() < tuning.pillar) continue;
    walls.push_back(line.segment);
    for (const Cell c : cellsAlong(blocked, line.segment.start, line.segment.end)) {
      for (int y = -kThick; y <= kThick; ++y) {
        for (int x = -kThick; x <= kThick; ++x) {
          if (rest.at(c + Cell{x, y}, 0)) rest[c + Cell{x, y}] = 0;
        }
      }
    }
  }
  const Components parts = connectedComponents(rest, 8);
  const std::vector<double> extent = extents(parts);
  std::vector<std::vector<Eigen::Vector2d>> islands(parts.sizes.size());
  for (std::size_t k = 0; k < rest.values.size(); ++k) {
    if (!rest.values[k]) continue;
    const auto part = static_cast<std::size_t>(parts.labels.values[k]);
    if (extent[part] <= tuning.pillar) islands[part].push_back(rest.centreOf(rest.cell(k)));
  }
  std::vector<char> is_in_front(parts.sizes.size(), 0);
  for (std::size_t k = 0; k < islands.size(); ++k) {
    is_in_front[k] =
        !islands[k].empty() &&
        std::any_of(walls.begin(), walls.end(), [&](const LineSegment& wall) {
          return isInFrontOf(wall, islands[k], rest.resolution, tuning.thinnest_pillar);
        });
  }
  for (std::size_t k = 0; k < rest.values.size(); ++k)
    rest.values[k] =
        rest.values[k] && is_in_front[static_cast<std::size_t>(parts.labels.values[k])];
  return rest;
}

Mask maskOf(const OccupancyRaster& grid, Occupancy value) {
  Mask mask = grid.alike(std::uint8_t{0});
  for (std::size_t k = 0; k < grid.values.size(); ++k) mask.values[k] = grid.values[k] == value;
  return mask;
}

/// The cells of `way` that a walk of at most `steps` over such cells joins to floor.
Mask besideFloor(const OccupancyRaster& grid, const Mask& way, int steps) {
  Mask reached = grid.alike(std::uint8_t{0});
  std::vector<std::size_t> front, next;
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    if (grid.values[k] == Occupancy::kFree) front.push_back(k);
  }
  for (; steps > 0; --steps) {
    next.clear();
    for (const std::size_t k : front) {
      for (const Cell step : kNeighbours) {
        const Cell c = grid.cell(k) + step;
        if (!way.at(c, 0) || reached[c]) continue;
        reached[c] = 1;
        next.push_back(grid.index(c));
      }
    }
    front.swap(next);
  }
  return reached;
}

/// Unknown stripes between beams: the morphological closing of the floor over unknown cells.
Mask betweenBeams(const OccupancyRaster& grid, double half_stripe) {
  const Mask unknown = maskOf(grid, Occupancy::kUnknown);
  Mask between =
      besideFloor(grid, unknown, static_cast<int>(std::lround(half_stripe / grid.resolution)));
  Mask beyond = unknown;
  for (std::size_t k = 0; k < beyond.values.size(); ++k)
    beyond.values[k] &= static_cast<std::uint8_t>(!between.values[k]);
  const Raster<float> from_beyond = distanceTransform(beyond);
  const double edge = half_stripe + 0.5 * grid.resolution;
  for (std::size_t k = 0; k < between.values.size(); ++k)
    between.values[k] &= static_cast<std::uint8_t>(from_beyond.values[k] > edge);
  return between;
}

/// Leaves out the parts of a space of which too little floor was seen: beams through a window make
/// such ones beyond it. @param wide  floor seen that is no slit.
void dropGlimpses(Mask& space, const Mask& wide, double least_seen) {
  const Components parts = connectedComponents(space, 4);
  std::vector<double> seen(parts.sizes.size(), 0.0);
  const double cell_area = space.resolution * space.resolution;
  for (std::size_t k = 0; k < space.values.size(); ++k) {
    if (space.values[k] && wide.values[k])
      seen[static_cast<std::size_t>(parts.labels.values[k])] += cell_area;
  }
  for (std::size_t k = 0; k < space.values.size(); ++k) {
    if (space.values[k] && seen[static_cast<std::size_t>(parts.labels.values[k])] < least_seen)
      space.values[k] = 0;
  }
}

/// The cells with at least so much clearance.
Mask atLeast(const Raster<float>& clearance, double least) {
  Mask wide = clearance.alike(std::uint8_t{0});
  for (std::size_t k = 0; k < wide.values.size(); ++k)
    wide.values[k] = clearance.values[k] >= least;
  return wide;
}

}  // namespace

bool standsOn(const Mask& solid, const LineSegment& line) {
  const std::vector<Cell> cells = cellsAlong(solid, line.start, line.end);
  const auto on = std::count_if(cells.begin(), cells.end(), [&](Cell c) { return solid[c] != 0; });
  return 2 * static_cast<std::size_t>(on) > cells.size();
}

OccupancyRaster cropToKnown(const OccupancyRaster& grid, int margin_cells) {
  Cell low{grid.columns, grid.rows}, high{-1, -1};
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    if (grid.values[k] == Occupancy::kUnknown) continue;
    const Cell c = grid.cell(k);
    low = {std::min(low.x, c.x), std::min(low.y, c.y)};
    high = {std::max(high.x, c.x), std::max(high.y, c.y)};
  }
  OccupancyRaster part;
  part.resolution = grid.resolution;
  if (high.x < 0) return part;
  low = low + Cell{-margin_cells, -margin_cells};
  high = high + Cell{margin_cells, margin_cells};
  part.columns = high.x - low.x + 1;
  part.rows = high.y - low.y + 1;
  // To a micrometre, as map.yaml has it: the same cells, however they were cut out, give one plan.
  part.origin = (1e6 * grid.inMetres({low.x, low.y})).array().round() / 1e6;
  part.values.reserve(static_cast<std::size_t>(part.columns) * static_cast<std::size_t>(part.rows));
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x)
      part.values.push_back(grid.at({x, y}, Occupancy::kUnknown));
  }
  return part;
}

Structure tellStructure(const OccupancyRaster& grid, const std::vector<MapLine>& lines,
                        const StructureTuning& tuning) {
  Mask crossed = grid.alike(std::uint8_t{0});
  for (const MapLine& line : lines) {
    for (const Cell c : cellsAlong(crossed, line.segment.start, line.segment.end)) crossed[c] = 1;
  }
  const Mask between = betweenBeams(grid, tuning.half_stripe);
  Mask blocked = crossed;
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    const bool is_floor = grid.values[k] == Occupancy::kFree || between.values[k];
    blocked.values[k] = crossed.values[k] || !is_floor;
  }
  const Mask in_front = inFrontOfWalls(blocked, lines, tuning);
  for (std::size_t k = 0; k < blocked.values.size(); ++k)
    blocked.values[k] &= static_cast<std::uint8_t>(!in_front.values[k]);
  const Components parts = connectedComponents(blocked, 8);
  const std::vector<char> is_furniture = furnitureAmong(parts, lines, tuning);
  Structure found{grid.alike(std::uint8_t{0}), grid.alike(std::uint8_t{0}),
                  grid.alike(std::uint8_t{0})};
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    const int label = parts.labels.values[k];
    const bool is_island = label >= 0 && is_furniture[static_cast<std::size_t>(label)];
    found.furniture.values[k] = is_island || in_front.values[k];
    found.open.values[k] = label < 0 && !in_front.values[k] && !between.values[k];
    found.solid.values[k] = label >= 0 && !is_island;
  }
  return found;
}

Mask spaceForRooms(const Structure& structure, const Raster<float>& clearance,
                   const StructureTuning& tuning) {
  const Raster<float> beside = distanceTransform(atLeast(clearance, tuning.half_slit));
  const double reach = kIntoCorner * tuning.half_slit + clearance.resolution;
  Mask space = structure.solid.alike(std::uint8_t{0}), unseen = space;
  for (std::size_t k = 0; k < space.values.size(); ++k) {
    space.values[k] = structure.solid.values[k] == 0 && beside.values[k] <= reach;
    unseen.values[k] = !structure.open.values[k] && !structure.furniture.values[k];
  }
  dropGlimpses(space, atLeast(distanceTransform(unseen), tuning.half_slit),
               RoomTuning{}.smallest_room);
  return space;
}

}  // namespace cca
