// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/floor_plan/raster.hpp"

namespace cca {

/// m, from the centre of each cell to that of the next set one: the exact Euclidean distance
/// transform [Felzenszwalb & Huttenlocher 2012]. What lies beyond the raster counts as set.
/// Cost: O(cells).
Raster<float> distanceTransform(const Mask& obstacles);

}  // namespace cca
