// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/mapping/map_line.hpp"

namespace cca {

/// Cosine of 14 degrees: lines that differ by more are those of two walls.
inline constexpr double kCosOneWall = 0.97;

/// Where a wall ends in open space: both faces end there.
struct WallEnd {
  Eigen::Vector2d point;      ///< m, map frame: between the ends of both faces
  Eigen::Vector2d direction;  ///< unit, out of the wall
  double thickness = 0.0;     ///< m, between the faces
};

struct WallEndTuning {
  double shortest_face = 0.4;  ///< m; below it a line is no face of a wall
  double thickest = 0.65;      ///< m; a thicker obstacle is a block with corners
  double uneven = 0.2;         ///< m; one face may end that much before the other
};

/// Pairs of lines that are the two faces of one wall, and end at the same place.
/// @param lines  the viewer on the left of each. Cost: O(n^2) for n lines.
std::vector<WallEnd> freeWallEnds(const Mask& solid, const std::vector<MapLine>& lines,
                                  const WallEndTuning& tuning = {});

}  // namespace cca
