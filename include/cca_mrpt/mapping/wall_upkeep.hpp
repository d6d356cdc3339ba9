// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "cca_mrpt/mapping/map_noise.hpp"
#include "cca_mrpt/mapping/similarity.hpp"
#include "cca_mrpt/mapping/walls.hpp"

namespace cca {

/// Sees to the walls that were touched: forgets refuted bins, fits, cuts where a wall bends, joins
/// walls that are one, and renews the pieces. Leaves nobody touched.
///
/// Both the cut and the join weigh description lengths: a line costs four coordinates, a bin off
/// its line costs half its squared deviation against the noise of a single scan.
void seeToTouched(Walls& walls, const MapNoise& noise, const AlphaCut& cut, std::uint64_t& next_id);

}  // namespace cca
