// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/mapping/map_line.hpp"
#include "floor_plan/wall_ends.hpp"

namespace cca {

/// What speaks for a border between rooms, in rising order.
enum class PassageEvidence {
  kNarrowing,  ///< the space is narrower there than on both sides; no line says that a wall goes on
  kAtCorner,   ///< a jamb is a corner of a block: the mouth of a corridor, if anything
  kAbutting,   ///< a wall ends, and its line goes on to the flank of another wall
  kCollinear,  ///< a wall's line goes on in another wall beyond the gap
  kBetweenEnds,  ///< both jambs are free ends of walls
};

/// A straight border across open space from wall to wall, where one room may end and another begin.
struct Passage {
  Eigen::Vector2d a, b;  ///< m, map frame: the jambs
  PassageEvidence evidence = PassageEvidence::kNarrowing;
  double support = 0.0;  ///< see wallSupport()
  double width() const { return (b - a).norm(); }
  Eigen::Vector2d middle() const { return 0.5 * (a + b); }
};

struct PassageTuning {
  double narrowest = 0.4;      ///< m; no person passes below it
  double widest = 2.7;         ///< m; of gaps that a wall's line crosses: a double door and some
  double widest_door = 1.4;    ///< m; a leaf and a half: beyond a wider gap begins another wall
  double shortest_wall = 0.3;  ///< m; a line below it is no wall that could go on
  double end_error = 0.3;      ///< m; lines end that much before their wall does
  double sideways = 0.3;       ///< m; a wall in line may be thicker, or stand off by that much
  double depth = 0.04;         ///< m; a wall's line is followed so far inside of its face
  double merge_within = 0.6;   ///< m; both faces of a wall make one passage
  double corner_cells = 3.0;   ///< cells beside a corner that noise may fill
  double deepest = 1.2;        ///< m; a narrow stretch that is longer is a corridor
  double ridge_drop = 0.9;     ///< a saddle below this share of the lower peak is a narrowing
};

/// Gaps in walls: each line is followed beyond its ends to the next wall.
/// @param solid  see Structure. @param lines  of the building, the viewer on the left of each.
/// Cost: O(lines x cells of the widest gap + gaps^2).
std::vector<Passage> gapsInWalls(const Mask& solid, const std::vector<MapLine>& lines,
                                 const PassageTuning& tuning = {});

/// Passages between two free ends of walls that see each other, whatever way the walls run.
/// Cost: O(n^2) for n ends.
std::vector<Passage> gapsBetweenEnds(const Mask& solid, const std::vector<WallEnd>& ends,
                                     const PassageTuning& tuning = {});

/// Passages from corners that stick out, straight off one of their faces to a wall that faces it.
/// Cost: O(n^2) for n lines.
std::vector<Passage> gapsAtCorners(const Mask& solid, const std::vector<MapLine>& lines,
                                   const PassageTuning& tuning = {});

/// How much of a passage's line is wall: the walls in line that lead up to both jambs, over these
/// and the width; 0 .. 1. The support ratio of a contour that an eye completes [Shipley & Kellman
/// 1992]. Cost: O(n log n) for n lines.
double wallSupport(const Passage& passage, const std::vector<MapLine>& lines,
                   const PassageTuning& tuning = {});

/// Moves a passage along its way to the middle of the stretch that is as narrow: into the middle of
/// the wall. One whose stretch is longer than `deepest` stays.
Passage centred(const Mask& solid, const Passage& passage, const PassageTuning& tuning = {});

/// Narrowings of the space itself: saddles of the distance to the next wall, where two basins of
/// the watershed meet at less than `ridge_drop` of the lower of their peaks.
/// @param clearance  m, distanceTransform(solid). Cost: O(n log n) for n open cells.
std::vector<Passage> narrowings(const Mask& solid, const Raster<float>& clearance,
                                const std::vector<WallEnd>& ends, const PassageTuning& tuning = {});

/// Gaps, and those narrowings that are none of them; what is below `narrowest` is left out.
/// Cost: O(n^2).
std::vector<Passage> joinPassages(std::vector<Passage> gaps, const std::vector<Passage>& narrowings,
                                  const PassageTuning& tuning = {});

}  // namespace cca
