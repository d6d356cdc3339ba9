// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "cca_mrpt/floor_plan/raster.hpp"

namespace cca::python {

namespace nb = nanobind;

/// 0 unknown, 1 free, 2 occupied; rows from the lowest y on.
using Cells = nb::ndarray<const std::uint8_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

inline constexpr std::size_t kLongestSide = 1 << 20;  // cells

/// @throws nb::value_error
inline OccupancyRaster rasterOf(const Cells& cells, double resolution,
                                std::pair<double, double> origin) {
  if (!(resolution > 0.0) || !std::isfinite(resolution))
    throw nb::value_error("resolution: must be above 0 m");
  if (!std::isfinite(origin.first) || !std::isfinite(origin.second))
    throw nb::value_error("origin: must be finite");
  if (cells.shape(0) > kLongestSide || cells.shape(1) > kLongestSide)
    throw nb::value_error("cells: too many for one grid");
  OccupancyRaster grid;
  grid.rows = static_cast<int>(cells.shape(0));
  grid.columns = static_cast<int>(cells.shape(1));
  grid.resolution = resolution;
  grid.origin = {origin.first, origin.second};
  grid.values.resize(cells.size());
  std::transform(cells.data(), cells.data() + cells.size(), grid.values.begin(),
                 [](std::uint8_t cell) {
                   return cell == 1   ? Occupancy::kFree
                          : cell == 2 ? Occupancy::kOccupied
                                      : Occupancy::kUnknown;
                 });
  return grid;
}

}  // namespace cca::python
