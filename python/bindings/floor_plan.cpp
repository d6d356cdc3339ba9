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
#include "io/replay/replay.hpp"
#include "module.hpp"
#include "raster.hpp"

namespace cca::python {
namespace {

namespace nb = nanobind;

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

/// @param origin_replay  m, map frame: where the frame of the run lies.
std::string replayWithRooms(const std::string& packed, std::pair<double, double> origin_replay,
                            const std::string& lines_csv, const Cells& cells, double resolution,
                            std::pair<double, double> origin) {
  const OccupancyRaster grid = rasterOf(cells, resolution, origin);
  const nb::gil_scoped_release others_may_run;
  std::vector<PlanRoom> rooms;
  try {
    rooms = floorPlan(grid, readLinesCsv(lines_csv, "lines.csv")).rooms;
  } catch (const std::exception&) {  // a map is a map without a plan, too
  }
  const Eigen::Vector2d p_frame(origin_replay.first, origin_replay.second);
  for (PlanRoom& room : rooms) {
    for (Eigen::Vector2d& p : room.outline) p -= p_frame;
    for (Polygon& hole : room.holes) {
      for (Eigen::Vector2d& p : hole) p -= p_frame;
    }
  }
  return replayPage({withRooms(packed, rooms)});
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
  module.def("replay_with_rooms", &replayWithRooms, nb::arg("packed"), nb::arg("frame_origin"),
             nb::arg("lines_csv"), nb::arg("cells"), nb::arg("resolution"), nb::arg("origin"),
             nb::sig("def replay_with_rooms(packed: str, frame_origin: tuple[float, float], "
                     "lines_csv: str, cells: numpy.typing.NDArray[numpy.uint8], resolution: float, "
                     "origin: tuple[float, float]) -> str"),
             "The replay.html of a run, with the rooms of its map.");
}

}  // namespace cca::python
