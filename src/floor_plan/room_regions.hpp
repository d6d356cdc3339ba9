// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "floor_plan/passages.hpp"

namespace cca {

/// When a passage parts two rooms. Its relative width is its width over that of the narrower of
/// both regions: that of sections beside it, at most twice the greatest clearance in the region;
/// or, for a gap that a wall or a corner speaks for, the side of a square of its area if that is
/// more.
struct RoomTuning {
  double widest_narrowing = 0.55;  ///< relative width; of kNarrowing in no wall, and kAtCorner
  /// Relative width of kAbutting, and of kNarrowing in a wall: one jamb is a mere flank.
  double widest_abutting = 0.85;
  double widest_collinear = 0.9;  ///< the same of kCollinear and kBetweenEnds
  /// The same of all of them across a corridor: between the recesses of its doors it is no narrower
  /// than elsewhere, though sections beside such a stretch end in the recesses.
  double widest_in_corridor = 0.75;
  /// A corridor goes on straight for more than so many of its widths, and has that many squares of
  /// its width; what is shorter is a niche.
  double shortest_corridor = 2.5;
  double corridor_width = 2.0;  ///< times a passage's width; what is wider anywhere is a hall
  /// Support [see wallSupport()] of a kAbutting below which the wall that ends there leads past the
  /// gap: it parts as a narrowing. Walls in line are then shorter than half of the gap.
  double least_support = 1.0 / 3.0;
  /// The same from which on a gap with two jambs lies in a wall: there is no less wall than gap.
  /// The space beside it then reaches over floor that was hidden, to the next thing seen: a room
  /// that was glimpsed through its door is no narrower than the door.
  double in_wall = 0.5;
  double least_step = 0.16;  ///< m, three cells; a door is that much narrower than the space beside
  /// The mouth of a corridor is as wide as that. Its relative width on the other side is at most
  /// that; a corridor with an alcove is twice as wide there, and one space still.
  double widest_mouth = 0.45;
  double widest_front = 0.6;      ///< the same between two wall ends
  double shallowest_mouth = 0.6;  ///< its width over the depth of the other side: no crossing
  /// m^2; a toilet has .9 by 1.2 m at least, of which the cells on its walls take half a cell each.
  double smallest_room = 1.0;
  /// m^2, 2 m by 2 m; of what no passage leads into, but for the largest room. Nobody was in there:
  /// beams through gaps show some floor behind a wall, a room of another building is larger.
  double smallest_closed = 4.0;
  double least_clearance = 0.15;  ///< m to the next wall; with less a gap is none to pass through
};

/// A passage between two rooms.
struct RoomBorder {
  Passage passage;
  std::array<int, 2> rooms{-1, -1};  ///< labels
};

struct RoomRegions {
  Raster<int> labels;  ///< 0 .. count - 1; -1: no room
  int count = 0;
  std::vector<RoomBorder> borders;
};

/// Parts the space between the walls into rooms.
///
/// All passages cut it; then regions join again, the two with the widest passage between them
/// first, until each passage that is left is narrow enough for its evidence.
/// @param space      where rooms may be: what is neither wall nor unknown.
/// @param clearance  m, distanceTransform() of the walls.
/// @param hidden     what nobody saw: no floor, no obstacle.
/// Cost: O(cells + regions x passages).
RoomRegions partitionIntoRooms(const Mask& space, const Raster<float>& clearance,
                               const Mask& hidden, const std::vector<Passage>& passages,
                               const RoomTuning& tuning = {});

}  // namespace cca
