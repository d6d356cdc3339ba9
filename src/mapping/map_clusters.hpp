// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/map_noise.hpp"
#include "mapping/map_similarity.hpp"
#include "mapping/rank_order_clustering.hpp"
#include "mapping/walls.hpp"

namespace cca {

/// The paper's last step: the new lines are clustered against the map's lines. Each line meets only
/// the walls near it; lines that are alike one wall, directly or through others, make one
/// neighbourhood with their walls; the Similarity Index Matrix and Rank Order Clustering run on
/// that. The lines of a group go to the wall of the group that they are most alike; a group without
/// a wall founds one, unless the map explains its lines already. The lines are those of one scan.
///
/// Several walls in one group are told to compare themselves with each other (see wall_upkeep.hpp).
///
/// Cost: O(lines x walls near a line), whatever the size of the map.
void clusterIntoMap(std::vector<NewLine>& lines, const AlphaCut& cut, const MapNoise& noise,
                    Walls& walls);

}  // namespace cca
