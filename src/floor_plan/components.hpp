// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/floor_plan/raster.hpp"

namespace cca {

/// Connected components of the set cells.
struct Components {
  Raster<int> labels;                 ///< 0 .. count - 1; -1 where the mask is not set
  std::vector<std::size_t> sizes;     ///< cells of each
  std::vector<Cell> lowest, highest;  ///< bounding boxes, both ends included
};

/// @param neighbours  4 or 8. Labels rise in the order of the first cell. Cost: O(cells).
Components connectedComponents(const Mask& mask, int neighbours);

}  // namespace cca
