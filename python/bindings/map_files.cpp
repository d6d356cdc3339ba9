// SPDX-License-Identifier: BSD-3-Clause
#include "map_files.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include "io/lines/line_formats.hpp"
#include "io/maps/map_frame.hpp"
#include "io/maps/occupancy_files.hpp"
#include "io/poses/local_frame.hpp"
#include "io/replay/replay.hpp"
#include "line_arrays.hpp"
#include "module.hpp"
#include "owned_array.hpp"

namespace cca::python {
namespace {

namespace nb = nanobind;

/// (array of Occupancy, rows from the lowest y on; resolution; origin).
nb::object gridTuple(const OccupancyRaster& grid) {
  auto cells = std::make_unique<std::uint8_t[]>(grid.values.size() + 1);
  std::transform(grid.values.begin(), grid.values.end(), cells.get(),
                 [](Occupancy state) { return static_cast<std::uint8_t>(state); });
  return nb::make_tuple(ownedArray(std::move(cells), static_cast<std::size_t>(grid.rows),
                                   static_cast<std::size_t>(grid.columns)),
                        grid.resolution, nb::make_tuple(grid.origin.x(), grid.origin.y()));
}

nb::object trajectoryArray(const std::vector<Pose2>& trajectory) {
  auto numbers = std::make_unique<double[]>(3 * trajectory.size() + 1);
  double* to = numbers.get();
  for (const Pose2& pose : trajectory) {
    *to++ = pose.x;
    *to++ = pose.y;
    *to++ = pose.theta;
  }
  return ownedArray(std::move(numbers), trajectory.size(), 3);
}

/// Of a map in the map frame.
nb::dict filesOf(const MapProducts& map) {
  nb::dict files;
  for (const auto& [name, content] : mapTexts(map)) {
    files[name.c_str()] = nb::bytes(content.data(), content.size());
  }
  return files;
}

nb::list arcsOf(const std::vector<MapArc>& arcs) {
  nb::list list;
  for (const MapArc& found : arcs) {
    const Arc& arc = found.arc;
    list.append(nb::make_tuple(nb::make_tuple(arc.centre.x(), arc.centre.y()), arc.radius,
                               arc.start_angle, arc.sweep, nb::cast(found.line_ids)));
  }
  return list;
}

}  // namespace

void addMapFiles(nb::module_& module) {
  module.def(
      "read_lines_csv",
      [](const std::string& csv, const std::string& name) {
        try {
          return lineArray(readLinesCsv(csv, name));
        } catch (const std::runtime_error& error) {
          throw nb::value_error(error.what());
        }
      },
      nb::arg("csv"), nb::arg("name"),
      nb::sig("def read_lines_csv(csv: str, name: str) -> numpy.typing.NDArray[numpy.void]"),
      "The lines of a lines.csv; covariances without their mixed term.");
  module.attr("FARTHEST_PLAN") = kFarthestPlan;
  module.def(
      "read_chains",
      [](const std::string& geojson, const std::string& name) {
        try {
          return readLinesGeoJson(geojson, name).poly_lines;
        } catch (const std::runtime_error& error) {
          throw nb::value_error(error.what());
        }
      },
      nb::arg("geojson"), nb::arg("name"), "The poly-lines of a lines.geojson, in metres.");
  module.def(
      "runs_of_page",
      [](const std::string& page, const std::string& name) {
        try {
          return runsOfReplayPage(page, name);
        } catch (const std::runtime_error& error) {
          throw nb::value_error(error.what());
        }
      },
      nb::arg("page"), nb::arg("name"), "The runs that a replay.html holds, packed.");
  module.def(
      "origin_of",
      [](const std::string& text) {
        const GeoReference place = geoReferenceOf(text);
        return nb::make_tuple(place.latitude_deg, place.longitude_deg, place.turn_deg);
      },
      nb::arg("text"), nb::sig("def origin_of(text: str) -> tuple[float, float, float]"),
      "(latitude, longitude, turn) of LAT,LON[,DEG], degrees.");
  module.def("page_of_runs", &replayPage, nb::arg("runs"), "The page of one run, or two.");
}

nb::object filesAndArrays(const MappedScans& result) {
  const Eigen::Vector2d& origin = result.products.origin;
  MapProducts map = seenFrom(-origin, result.products);
  if (map.grid) map.grid = asWritten(std::move(*map.grid), origin);
  double length = 0.0;
  for (const MapLine& line : map.lines) length += line.segment.length();
  nb::list is_placed;
  for (const bool placed : result.is_placed) is_placed.append(placed);
  nb::dict held;
  held["lines"] = lineArray(map.lines);
  held["poly_lines"] = nb::cast(map.poly_lines);
  held["arcs"] = arcsOf(map.arcs);
  held["trajectory"] = trajectoryArray(map.trajectory);
  held["times"] = nb::cast(map.times);
  held["is_placed"] = is_placed;
  held["warnings"] = result.warnings;
  held["shortcoming"] = result.shortcoming;
  held["replay"] = map.replay;
  held["frame_origin"] = nb::make_tuple(origin.x(), origin.y());
  if (const auto& place = map.place) {
    held["place"] = nb::make_tuple(place->latitude_deg, place->longitude_deg, place->turn_deg);
  }
  held["grid"] = map.grid ? gridTuple(*map.grid) : nb::none();
  auto& summary = map.summary;
  if (!origin.isZero()) summary["frame_origin_m"] = {origin.x(), origin.y()};
  summary["map_lines"] = map.lines.size();
  summary["map_poly_lines"] = map.poly_lines.size();
  summary["map_arcs"] = map.arcs.size();
  summary["map_length_m"] = length;
  held["summary"] = summary.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  return nb::make_tuple(held, filesOf(map));
}

}  // namespace cca::python
