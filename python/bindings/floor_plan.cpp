// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/floor_plan/floor_plan.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "io/lines/line_formats.hpp"
#include "io/plans/plan_formats.hpp"
#include "module.hpp"

namespace cca::python {
namespace {

namespace nb = nanobind;

using Cells = nb::ndarray<const std::uint8_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

constexpr std::size_t kLongestSide = 1 << 20;  // cells

OccupancyRaster rasterOf(const Cells& cells, double resolution, std::pair<double, double> origin) {
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

std::string geoJsonOfPlan(const std::string& lines_csv, const Cells& cells, double resolution,
                          std::pair<double, double> origin) {
  const OccupancyRaster grid = rasterOf(cells, resolution, origin);
  try {
    const nb::gil_scoped_release others_may_run;
    return planGeoJson(floorPlan(grid, readLinesCsv(lines_csv, "lines.csv")));
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
}

}  // namespace

void addFloorPlan(nb::module_& module) {
  module.def("floor_plan_geojson", &geoJsonOfPlan, nb::arg("lines_csv"), nb::arg("cells"),
             nb::arg("resolution"), nb::arg("origin"),
             nb::sig("def floor_plan_geojson(lines_csv: str, cells: "
                     "numpy.typing.NDArray[numpy.uint8], resolution: float, "
                     "origin: tuple[float, float]) -> str"),
             "The plan.geojson of a lines.csv and a grid: 0 unknown, 1 free, 2 occupied; rows from "
             "the lowest y on.");
}

}  // namespace cca::python
