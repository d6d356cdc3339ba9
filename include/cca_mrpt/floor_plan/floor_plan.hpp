// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/geometry/polygon.hpp"
#include "cca_mrpt/mapping/map_line.hpp"

namespace cca {

/// A straight wall. One that was seen from one side only has no thickness.
struct PlanWall {
  int id = 0;
  Eigen::Vector2d start, end;  ///< m, map frame: the centre line; of one face, that face
  double thickness = 0.0;      ///< m, between the faces; 0: one face only
  std::vector<std::uint64_t> left, right;  ///< ids of the lines of both faces, seen from start
  bool is_presumed = false;                ///< behind furniture, by the wall on both sides of it
};

enum class OpeningKind {
  kDoor,     ///< in a wall, up to 1.4 m wide
  kPassage,  ///< up to 2.5 m, or where a corridor begins
  kWide,     ///< wider
};

/// Where one room opens into another.
struct PlanOpening {
  int id = 0;
  OpeningKind kind = OpeningKind::kDoor;
  Eigen::Vector2d a, b;            ///< m, map frame: the jambs, in the middle of the wall
  std::array<int, 2> rooms{0, 0};  ///< ids
  double width() const { return (b - a).norm(); }
};

/// A room: floor between the faces of walls, and the openings to other rooms.
struct PlanRoom {
  int id = 0;
  std::string name;            ///< empty until somebody names it
  Polygon outline;             ///< m, map frame, counter-clockwise
  std::vector<Polygon> holes;  ///< clockwise: pillars, shafts, blocks of other rooms
  double area = 0.0;           ///< m^2, without the holes
  double perimeter = 0.0;      ///< m, of the outline and the holes, openings included
  double unseen_area = 0.0;    ///< m^2 of its area that no beam has crossed: under furniture
  double open_border =
      0.0;  ///< m of its border that is neither wall nor opening: where the map ends
  /// m: the place with the most free floor around, for its name, and for robots to be sent to.
  Eigen::Vector2d label = Eigen::Vector2d::Zero();
};

/// An obstacle that is no part of the building.
struct PlanFurniture {
  int id = 0;
  Polygon outline;     ///< m, map frame
  bool leans = false;  ///< on a wall, that is presumed behind it
  int room = 0;        ///< id; 0: in none
};

/// A floor plan. Ids count from 1 within each kind; all is in metres of the map frame.
struct FloorPlan {
  std::vector<PlanWall> walls;
  std::vector<PlanOpening> openings;
  std::vector<PlanRoom> rooms;
  std::vector<PlanFurniture> furniture;
  Raster<int> room_of;  ///< id of the room of each cell, 0: none; over the known part of the grid
};

/// The floor plan of a finished map.
///
/// @param grid   occupancy of the place; where nothing is known, the plan is empty.
/// @param lines  of the same place, the viewer on the left of each; may be empty: then the rooms
/// are
///               parted by narrowings alone, and follow the cells. Dotted ones part none.
/// The same input gives the same plan, and ids. Cost: .5 s for 1000 m^2 at 5 cm.
FloorPlan floorPlan(const OccupancyRaster& grid, const std::vector<MapLine>& lines);

/// The room that a point lies in; 0: in none. @param p  m, map frame.
int roomAt(const FloorPlan& plan, const Eigen::Vector2d& p);

}  // namespace cca
