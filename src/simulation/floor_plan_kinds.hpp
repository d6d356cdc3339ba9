// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/simulation/floor_plan.hpp"
#include "cca_mrpt/simulation/random.hpp"

namespace cca {

// Each gives one kind of building; the random stream varies it.
FloorPlan twoRooms(Random& random);
FloorPlan office(Random& random);
FloorPlan apartment(Random& random);
FloorPlan warehouse(Random& random);
FloorPlan corridorLoop(Random& random);
FloorPlan pillarHall(Random& random);
FloorPlan gallery(Random& random);
FloorPlan maze(Random& random);
FloorPlan randomBuilding(Random& random);
FloorPlan crowdedBuilding(Random& random);

}  // namespace cca
