// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cca_mrpt/floor_plan/raster.hpp"

namespace cca {

/// Writes MRPT's own file of a grid (.gridmap.gz): free 1, occupied 0, unknown one half.
/// @throws std::runtime_error naming the file and the reason.
void writeGridMap(const std::string& path, const OccupancyRaster& grid);

}  // namespace cca
