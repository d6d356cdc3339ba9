// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/exploration_grid.hpp"

namespace cca {

void ExplorationGrid::insert(const Scan&) {}

}  // namespace cca
