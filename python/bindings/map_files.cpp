// SPDX-License-Identifier: BSD-3-Clause
#include "map_files.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include "cca_mrpt/io/pose_files.hpp"
#include "io/lines/line_formats.hpp"
#include "io/poses/local_frame.hpp"
#include "io/replay/replay.hpp"
#include "line_arrays.hpp"
#include "module.hpp"
#include "owned_array.hpp"

namespace cca::python {
namespace {

namespace nb = nanobind;

/// Into the map frame, as writeMapFolder() does: by one addition, so that the same numbers come
/// out.
void moveToMapFrame(MappedScans& result) {
  const Eigen::Vector2d p_frame = -result.origin;
  for (MapLine& line : result.map.lines) {
    line.segment.start -= p_frame;
    line.segment.end -= p_frame;
    line.segment.moments.mean -= p_frame;
  }
  for (PolyLine& chain : result.map.poly_lines) {
    for (auto& vertex : chain.vertices) vertex -= p_frame;
  }
  for (MapArc& arc : result.map.arcs) arc.arc.centre -= p_frame;
  for (Pose2& pose : result.trajectory) pose = seenFrom(p_frame, pose);
  for (int k = 0; k < result.graph.size(); ++k)
    result.graph.place(k, seenFrom(p_frame, result.graph.pose(k)));
  result.grid.origin -= p_frame;
}

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

std::vector<StampedPose> stamped(const MappedScans& result) {
  std::vector<StampedPose> poses;
  for (std::size_t k = 0; k < result.trajectory.size(); ++k)
    poses.push_back({result.times[k], result.trajectory[k]});
  return poses;
}

nb::dict filesOf(const MappedScans& result) {
  nb::dict files;
  const auto put = [&files](const char* name, const std::string& content) {
    files[name] = nb::bytes(content.data(), content.size());
  };
  const auto& [lines, poly_lines, arcs] = result.map;
  put("lines.csv", linesCsv(lines));
  put("arcs.csv", arcsCsv(arcs));
  put("lines.geojson", linesGeoJson(lines, poly_lines, result.trajectory, arcs));
  put("lines.svg", linesSvg(lines, poly_lines, result.trajectory, arcs));
  put("lines.dxf", linesDxf(lines, poly_lines, result.trajectory, arcs));
  if (!result.trajectory.empty()) {
    put("poses.csv", posesCsv(stamped(result)));
    put("poses.tum", posesTum(stamped(result)));
  }
  if (result.graph.size() > 0) {
    put("graph.g2o", graphG2o(result.graph));
    put(kMemoryFile, packedMemory(result.memory));
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
      "read_chains",
      [](const std::string& geojson, const std::string& name) {
        return readLinesGeoJson(geojson, name).poly_lines;
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
  module.def("page_of_runs", &replayPage, nb::arg("runs"), "The page of one run, or two.");
}

nb::object filesAndArrays(MappedScans result) {
  moveToMapFrame(result);
  double length = 0.0;
  for (const MapLine& line : result.map.lines) length += line.segment.length();
  nb::list is_placed;
  for (const bool placed : result.is_placed) is_placed.append(placed);
  nb::dict held, summary;
  held["lines"] = lineArray(result.map.lines);
  held["poly_lines"] = nb::cast(result.map.poly_lines);
  held["arcs"] = arcsOf(result.map.arcs);
  held["trajectory"] = trajectoryArray(result.trajectory);
  held["times"] = nb::cast(result.times);
  held["is_placed"] = is_placed;
  held["warnings"] = result.warnings;
  held["shortcoming"] = result.shortcoming;
  held["replay"] =
      nb::make_tuple(result.replay, nb::make_tuple(result.origin.x(), result.origin.y()));
  held["grid"] = gridTuple(result.grid);
  summary["finished"] = result.finished;
  summary["pose"] = result.pose;
  summary["scans"] = result.trajectory.size();
  summary["beams"] = result.beams;
  summary["distance_m"] = result.distance;
  summary["agreement"] = result.agreement;
  if (result.graph.size() > 0) {
    summary["key_frames"] = result.graph.size();
    summary["loops"] = result.loops;
  }
  if (result.found_in_memory) {
    summary["resumed"] = result.resumed;
    summary["found_in_memory"] = *result.found_in_memory;
  }
  if (!result.origin.isZero())
    summary["frame_origin_m"] = nb::make_tuple(result.origin.x(), result.origin.y());
  summary["map_lines"] = result.map.lines.size();
  summary["map_poly_lines"] = result.map.poly_lines.size();
  summary["map_arcs"] = result.map.arcs.size();
  summary["map_length_m"] = length;
  held["summary"] = summary;
  return nb::make_tuple(held, filesOf(result));
}

}  // namespace cca::python
