// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/geometry/polygon.hpp"

namespace cca {

/// The border of a set of cells with one label: closed chains of cell corners, in cells, the set on
/// their left; outlines run counter-clockwise, holes clockwise. A chain names each corner of a cell
/// that it passes; where it would touch itself, it keeps off by a fraction of a cell.
struct RegionOutline {
  std::vector<Polygon> outlines, holes;
};

/// @param labels  any. The set need not hang together; it is taken as 4-connected.
/// @param count   labels are 0 .. count - 1. @return  one for each label. Cost: O(cells).
std::vector<RegionOutline> outlinesOfRegions(const Raster<int>& labels, int count);

/// Signed area; positive where the corners run counter-clockwise.
double signedArea(const Polygon& polygon);

}  // namespace cca
