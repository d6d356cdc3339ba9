// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"

namespace cca {

struct PlanWallTuning {
  double thickest = 0.6;       ///< m; two faces that are farther apart are those of two walls
  double thinnest = 0.02;      ///< m; nearer ones are one face seen twice
  double shortest = 0.2;       ///< m; a shorter stretch is left out
  double shortest_face = 0.5;  ///< m; the same where one face only is known: less may be furniture
  double parallel_deg = 3;     ///< faces of one wall differ by less
};

/// The walls whose faces the lines are.
///
/// Two lines that face away from each other, with nothing open between them, are the faces of one
/// wall as far as they lie side by side; of several partners the nearest one counts. What is left
/// of a line is a wall of one face.
/// @param solid  see Structure. @param lines  of the building, see standsOn().
/// Cost: O(n^2) for n lines.
std::vector<PlanWall> wallsOfLines(const Mask& solid, const std::vector<MapLine>& lines,
                                   const PlanWallTuning& tuning = {});

}  // namespace cca
