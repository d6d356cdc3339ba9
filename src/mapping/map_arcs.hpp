// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/map_line.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "mapping/map_noise.hpp"
#include "mapping/wall.hpp"

namespace cca {

/// The arcs among the walls' pieces: pieces whose ends follow one another are a chain, of which
/// arcsOfChain() tells by the mean points of their bins which are chords of one circle.
/// @return  in the order of the smallest id of each chain's beginning.
/// Cost: O(n log n) for n pieces, and O(length) fits for each chain.
std::vector<MapArc> arcsOfWalls(const std::vector<Wall>& walls, const MapNoise& noise,
                                const CcaParameters& parameters);

}  // namespace cca
