// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"
#include "floor_plan/passages.hpp"

namespace cca {

struct FurnitureTuning {
  double least_depth = 0.12, most_depth = 1.0;  ///< m; of what leans on a wall
  double most_width = 4.5;   ///< m along the wall; beyond it the wall itself stands forward
  double wall_beside = 0.2;  ///< m of the wall on both sides of it
  double in_line = 0.08;     ///< m from one of these to the other's line
  double smallest = 0.0075;  ///< m^2, three cells of 5 cm: less is noise
};

/// What stands free: the outlines of the islands of the mask, straightened.
std::vector<PlanFurniture> freeStanding(const Mask& furniture, const FurnitureTuning& tuning = {});

/// Where a room's outline steps off a wall's line and comes back to the same line, something leans
/// on it. The steps are cut from the outline, so that it follows the presumed wall, and returned as
/// furniture. A step whose inside has been seen to be something else stays, as does one beside an
/// opening: between two doors the wall itself steps into the room, by half of its thickness.
/// @param room_of   label of the room of each cell; 0: none.
/// @param openings  of the room.
std::vector<PlanFurniture> cutLeaning(Polygon& outline, const Raster<int>& room_of,
                                      const std::vector<Passage>& openings,
                                      const FurnitureTuning& tuning = {});

}  // namespace cca
