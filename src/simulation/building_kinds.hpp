// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/simulation/building.hpp"
#include "simulation/random.hpp"

namespace cca {

// Each gives one kind of building; the random stream varies it.
Building twoRooms(Random& random);
Building office(Random& random);
Building apartment(Random& random);
Building warehouse(Random& random);
Building corridorLoop(Random& random);
Building pillarHall(Random& random);
Building gallery(Random& random);
Building maze(Random& random);
Building randomBuilding(Random& random);
Building crowdedBuilding(Random& random);

}  // namespace cca
