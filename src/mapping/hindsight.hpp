// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/sensing/past_scans.hpp"
#include "mapping/map_noise.hpp"
#include "mapping/walls.hpp"

namespace cca {

/// Assigns the evidence of all scans anew to the walls that they have made: each return to the wall
/// on which it lies now, each ray to the walls that it goes through now.
///
/// While a map grows, a ray says nothing of a wall that is founded later, and a return counts for
/// the wall that was known when it came. What only scans that were not kept have seen stays, where
/// no ray of those kept went through.
///
/// @param uses_rays  false: rays say nothing, see Part::kRays.
/// @param walls  all of them are touched, and are compared with their neighbours when they are
///               seen to.
/// Cost: that of the returns and rays of an insertion for each scan; O(bins) more.
void reassignEvidence(const std::vector<PastScans::Kept>& scans, const MapNoise& noise,
                      bool uses_rays, Walls& walls);

}  // namespace cca
