// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/map_noise.hpp"
#include "mapping/similarity.hpp"
#include "mapping/walls.hpp"

namespace cca {

/// Sees to the walls that were touched: forgets refuted bins, fits, cuts where a wall bends, joins
/// walls that are one, and renews the pieces. Leaves nobody touched.
///
/// The cut weighs description lengths: a bend costs a vertex, a bin off its line half its squared
/// deviation against the noise of a single scan.
void seeToTouched(Walls& walls, const MapNoise& noise, const CcaParameters& parameters,
                  std::uint64_t& next_id);

}  // namespace cca
