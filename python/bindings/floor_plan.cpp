// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/floor_plan/floor_plan.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "arguments.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "io/lines/line_formats.hpp"
#include "io/plans/plan_files.hpp"
#include "io/plans/plan_formats.hpp"
#include "io/replay/replay.hpp"
#include "module.hpp"
#include "raster.hpp"
#ifdef CCA_CAIRO
#include "io/maps/map_picture.hpp"
#include "io/maps/occupancy_files.hpp"
#endif

namespace cca::python {
namespace {

namespace nb = nanobind;

using Place = std::pair<double, double>;
using Ends = nb::ndarray<const double, nb::shape<-1, 2, 2>, nb::c_contig, nb::device::cpu>;
using Poses = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

nb::dict bytesOf(const NamedFiles& files) {
  nb::dict contents;
  for (const auto& [name, content] : files)
    contents[name.c_str()] = nb::bytes(content.data(), content.size());
  return contents;
}

NamedFiles allFilesOf(const FloorPlan& plan, const std::string& title,
                      const std::optional<GeoReference>& place) {
#ifdef CCA_CAIRO
  return planFiles(plan, title, place);
#else
  return planTexts(plan, title, place);
#endif
}

/// A plan, and the labels that lie in none of its rooms.
struct NamedPlan {
  FloorPlan plan;
  RoomLabels outside;
};

/// @param grid_name, labels_name  of their files, for messages.
NamedPlan planOf(const std::string& lines_csv, const OccupancyRaster& grid,
                 const std::string& grid_name, const std::optional<std::string>& labels,
                 const std::string& labels_name) {
  const std::vector<MapLine> lines = readLinesCsv(lines_csv, "lines.csv");
  requireCommonPlace(lines, grid, grid_name);
  NamedPlan named;
  named.plan = floorPlan(grid, lines);
  const RoomLabels places = labels ? readRoomLabels(*labels, labels_name) : RoomLabels();
  named.outside = nameRooms(named.plan, places);
  return named;
}

nb::object geoJsonOfPlan(const std::string& lines_csv, const Cells& cells, double resolution,
                         const Place& origin, const std::string& grid_name,
                         const std::optional<std::string>& labels, const std::string& labels_name) {
  const OccupancyRaster grid = rasterOf(cells, resolution, origin);
  NamedPlan named;
  try {
    const nb::gil_scoped_release others_may_run;
    named = planOf(lines_csv, grid, grid_name, labels, labels_name);
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
  nb::list outside;
  for (const auto& [p, name] : named.outside)
    outside.append(nb::make_tuple(p.x(), p.y(), nb::bytes(name.data(), name.size())));
  return nb::make_tuple(planGeoJson(named.plan), outside);
}

nb::dict filesOfPlan(const std::string& lines_csv, const Cells& cells, double resolution,
                     const Place& origin, const std::optional<std::string>& labels,
                     const std::string& title, nb::handle place) {
  const std::optional<GeoReference> on_earth = readOrigin(place);
  const OccupancyRaster grid = rasterOf(cells, resolution, origin);
  NamedFiles files;
  try {
    const nb::gil_scoped_release others_may_run;
    const FloorPlan plan = planOf(lines_csv, grid, "map.yaml", labels, "labels").plan;
    files = allFilesOf(plan, title, on_earth);
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
  return bytesOf(files);
}

/// @param p_frame  m, map frame: where the frame of the run lies, in which a map is drawn.
MapProducts productsOf(const std::string& title, const std::string& lines_csv, const Ends& ends,
                       std::vector<PolyLine> poly_lines, const Poses& trajectory,
                       const Eigen::Vector2d& p_frame) {
  MapProducts products;
  products.title = title;
  products.lines = readLinesCsv(lines_csv, "lines.csv");
  if (products.lines.size() != ends.shape(0))
    throw nb::value_error("ends: a row for each row of lines_csv is needed");
  for (std::size_t k = 0; k < products.lines.size(); ++k) {
    const double* p = ends.data() + 4 * k;
    products.lines[k].segment.start = {p[0], p[1]};
    products.lines[k].segment.end = {p[2], p[3]};
  }
  products.poly_lines = std::move(poly_lines);
  for (std::size_t k = 0; k < trajectory.shape(0); ++k) {
    const double* p = trajectory.data() + 3 * k;
    products.trajectory.push_back({p[0], p[1], p[2]});
  }
  return seenFrom(p_frame, std::move(products));
}

/// The floor plan's files, map.png, where it can be drawn, and replay.html, where there is a run.
/// @param grid  in the map frame, as it is written.
NamedFiles picturesOf(MapProducts products, OccupancyRaster grid, const std::string& lines_csv,
                      const std::string& packed) {
  NamedFiles files;
  std::vector<PlanRoom> rooms;
  try {
    const FloorPlan plan = floorPlan(grid, readLinesCsv(lines_csv, "lines.csv"));
    rooms = seenFrom(products.origin, plan.rooms);
    if (!grid.values.empty()) files = allFilesOf(plan, products.title, products.place);
  } catch (const std::exception&) {  // a map is a map without a plan, too
  }
#ifdef CCA_CAIRO
  grid.origin -= products.origin;
  if (!grid.values.empty()) {
    products.grid = asWritten(std::move(grid), Eigen::Vector2d::Zero());
  }
  PictureOptions options;
  options.rooms = rooms;
  files.emplace_back("map.png", picturePng(products, options));
#endif
  if (!packed.empty()) files.emplace_back("replay.html", replayPage({withRooms(packed, rooms)}));
  return files;
}

nb::dict picturesOfMap(const std::string& title, const std::string& lines_csv, const Ends& ends,
                       std::vector<PolyLine> poly_lines, const Poses& trajectory,
                       const Cells& cells, double resolution, const Place& origin,
                       const Place& frame_origin, const std::string& packed, nb::handle place) {
  MapProducts products = productsOf(title, lines_csv, ends, std::move(poly_lines), trajectory,
                                    {frame_origin.first, frame_origin.second});
  products.place = readOrigin(place);
  OccupancyRaster grid = rasterOf(cells, resolution, origin);
  NamedFiles files;
  {
    const nb::gil_scoped_release others_may_run;
    files = picturesOf(std::move(products), std::move(grid), lines_csv, packed);
  }
  return bytesOf(files);
}

void writePlan(const std::string& folder, const nb::dict& files, bool overwrite) {
  NamedFiles named;
  for (const auto [name, content] : files) {
    const auto bytes = nb::cast<nb::bytes>(content);
    named.emplace_back(nb::cast<std::string>(name), std::string(bytes.c_str(), bytes.size()));
  }
  writePlanFiles(folder, named, overwrite);
}

}  // namespace

void addFloorPlan(nb::module_& module) {
  module.def("floor_plan_geojson", &geoJsonOfPlan, nb::arg("lines_csv"), nb::arg("cells"),
             nb::arg("resolution"), nb::arg("origin"), nb::arg("grid_name"),
             nb::arg("labels").none(), nb::arg("labels_name"),
             nb::sig("def floor_plan_geojson(lines_csv: str, cells: "
                     "numpy.typing.NDArray[numpy.uint8], resolution: float, "
                     "origin: tuple[float, float], grid_name: str, labels: str | None, "
                     "labels_name: str) -> tuple[str, list[tuple[float, float, bytes]]]"),
             "The plan.geojson of a lines.csv and a grid (0 unknown, 1 free, 2 occupied; rows from "
             "the lowest y on), and the labels that lie in no room.");
  module.def("floor_plan_files", &filesOfPlan, nb::arg("lines_csv"), nb::arg("cells"),
             nb::arg("resolution"), nb::arg("origin"), nb::arg("labels").none(), nb::arg("title"),
             nb::arg("place").none(),
             nb::sig("def floor_plan_files(lines_csv: str, cells: "
                     "numpy.typing.NDArray[numpy.uint8], resolution: float, "
                     "origin: tuple[float, float], labels: str | None, title: str, "
                     "place: collections.abc.Sequence[float] | None) -> "
                     "dict[str, bytes]"),
             "All files of such a plan, by name; without Cairo no plan.pdf and rooms.png.");
  module.def("write_plan_files", &writePlan, nb::arg("folder"), nb::arg("files"),
             nb::arg("overwrite"),
             nb::sig("def write_plan_files(folder: str, files: dict[str, bytes], overwrite: bool) "
                     "-> None"),
             "Write them; where others are there already, only if they may be overwritten.");
  module.def("title_of_folder", &titleOfFolder, nb::arg("folder"),
             "What a map's folder is the map of, for people.");
  module.def("pictures_of_map", &picturesOfMap, nb::arg("title"), nb::arg("lines_csv"),
             nb::arg("ends"), nb::arg("poly_lines"), nb::arg("trajectory"), nb::arg("cells"),
             nb::arg("resolution"), nb::arg("origin"), nb::arg("frame_origin"), nb::arg("packed"),
             nb::arg("place").none(),
             nb::sig("def pictures_of_map(title: str, lines_csv: str, "
                     "ends: numpy.typing.NDArray[numpy.float64], "
                     "poly_lines: collections.abc.Sequence[PolyLine], "
                     "trajectory: numpy.typing.NDArray[numpy.float64], "
                     "cells: numpy.typing.NDArray[numpy.uint8], resolution: float, "
                     "origin: tuple[float, float], frame_origin: tuple[float, float], "
                     "packed: str, place: collections.abc.Sequence[float] | None) -> "
                     "dict[str, bytes]"),
             "map.png, and the replay.html of a run, with the rooms of its map.");
}

}  // namespace cca::python
