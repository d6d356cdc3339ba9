// SPDX-License-Identifier: BSD-3-Clause
#include "mapping.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <optional>

#include "arguments.hpp"
#include "cca_mrpt/mapping/line_extraction.hpp"
#include "io/lines/line_formats.hpp"
#include "line_arrays.hpp"
#include "module.hpp"
#include "parameters.hpp"
#include "unpickled.hpp"

namespace cca::python {
namespace {

constexpr const char* kLines = "numpy.typing.NDArray[numpy.void]";  ///< of dtype LINE or MAP_LINE

nb::object extract(nb::handle ranges, double angle_min, double angle_increment,
                   nb::kwargs keywords) {
  CcaParameters parameters;
  readParameters(keywords, parameters);
  thread_local Scan scan;  // keeps its memory from call to call
  readScan(ranges, angle_min, angle_increment, scan);
  std::vector<LineSegment> lines;
  {
    const nb::gil_scoped_release others_may_run;
    lines = extractLines(scan, parameters);
  }
  return lineArray(lines);
}

void insertIntoMap(SharedLineMap& map, nb::handle ranges, double angle_min, double angle_increment,
                   nb::handle pose, double free_range_without_return) {
  Scan scan;
  readScan(ranges, angle_min, angle_increment, scan);
  readPlace(pose, free_range_without_return, scan);
  if (!map.with([&scan](LineMap& own) { return own.insert(scan); }))
    throw nb::value_error("pose: further than 10 000 km from the map's origin");
}

struct LinesAndChains {
  std::vector<MapLine> lines;
  std::vector<PolyLine> poly_lines;
  std::vector<MapArc> arcs;
};

LinesAndChains everything(SharedLineMap& map) {
  return map.with([](LineMap& own) {
    return LinesAndChains{own.lines(), own.polyLines(), own.arcs()};
  });
}

std::vector<Pose2> readTrajectory(nb::handle from) {
  std::vector<Pose2> poses;
  if (from.is_none()) return poses;
  for (const nb::handle pose : nb::iter(from)) poses.push_back(readPose(pose, "trajectory"));
  return poses;
}

template <class Write>
auto placedWriter(Write write) {
  return [write](SharedLineMap& map, nb::handle trajectory, nb::handle origin) {
    const std::vector<Pose2> poses = readTrajectory(trajectory);
    const std::optional<GeoReference> place = readOrigin(origin);
    const LinesAndChains all = everything(map);
    return write(all.lines, all.poly_lines, poses, all.arcs, place);
  };
}

template <class Write>
auto writer(Write write) {
  return [write](SharedLineMap& map, nb::handle trajectory) {
    const std::vector<Pose2> poses = readTrajectory(trajectory);
    const LinesAndChains all = everything(map);
    return write(all.lines, all.poly_lines, poses, all.arcs);
  };
}

void addLineMap(nb::module_& module) {
  static const std::string docs = parameterDocs<CcaParameters>(
      "A line map that grows scan by scan, in the frame of the poses [m].\n\n"
      "May be used by several threads: their calls wait for each other.");
  static const std::string signature = parameterSignature<CcaParameters>("__init__(self", "None");
  const auto copyOf = [](SharedLineMap& map) {
    return new SharedLineMap(map.with([](LineMap& own) { return own; }));
  };
  const auto count = [](SharedLineMap& map) {
    return map.with([](LineMap& own) { return own.lines().size(); });
  };
  nb::class_<SharedLineMap> line_map_type(module, "LineMap", docs.c_str());
  refusePickle(line_map_type,
               "a LineMap cannot be pickled: it holds the evidence of each wall, which no file of "
               "ours has; copy it, or pickle its lines() or a Map (cca_mrpt.map)");
  line_map_type
      .def(
          "__init__",
          [](SharedLineMap* self, nb::kwargs keywords) {
            CcaParameters parameters;
            readParameters(keywords, parameters);
            new (self) SharedLineMap(LineMap(parameters));
          },
          nb::arg("parameters"), nb::sig(signature.c_str()))
      .def("insert", &insertIntoMap, nb::arg("ranges").none(), nb::arg("angle_min"),
           nb::arg("angle_increment"), nb::arg("pose").none(),
           nb::arg("free_range_without_return") = 0.0,
           nb::sig("def insert(self, ranges: numpy.typing.ArrayLike, angle_min: float, "
                   "angle_increment: float, pose: collections.abc.Sequence[float], "
                   "free_range_without_return: float = 0.0) -> None"),
           R"(Take a scan.

Args:
    ranges: (N,) m, beam by beam; +inf: no return; NaN, 0 and negative: invalid.
    angle_min: rad, bearing of beam 0 in the sensor frame, counter-clockwise.
    angle_increment: rad, from beam to beam; negative where the laser turns clockwise.
    pose: (x, y, theta) of the sensor in the map frame; m, m, rad.
    free_range_without_return: m, up to which a beam without return is known to be free. Of a laser that loses beams
        singly, which its driver tells as +inf too, `MissingReturns` tells the lost ones; `Mapper` and `Explorer` ask
        it by themselves.

Raises:
    ValueError: naming the argument.)")
      .def(
          "lines",
          [](SharedLineMap& map) {
            return lineArray(map.with([](LineMap& own) { return own.lines(); }));
          },
          nb::sig("def lines(self) -> numpy.typing.NDArray[numpy.void]"),
          R"(The lines as they stand, by rising id: structured array of dtype `MAP_LINE`.

Fields: `id`, stable while the line exists; `ends` (2, 2), [[x1, y1], [x2, y2]] in m, map frame, seen
from the left of the way from first to second; `covariance` (2, 2) of (lateral offset at the centroid
of the returns [m], orientation [rad]); `returns`, laser returns that it stands on.)")
      .def(
          "poly_lines",
          [](SharedLineMap& map) { return map.with([](LineMap& own) { return own.polyLines(); }); },
          "The same lines, chained where their ends meet; a line alone is a chain of one.")
      .def("to_geojson", placedWriter(linesGeoJson), nb::arg("trajectory").none() = nb::none(),
           nb::arg("origin").none() = nb::none(),
           nb::sig("def to_geojson(self, trajectory: numpy.typing.ArrayLike | None = None, "
                   "origin: collections.abc.Sequence[float] | None = None) -> str"),
           R"(GeoJSON FeatureCollection of lines, poly-lines and arcs.

Args:
    trajectory: (N, 3) poses (x, y, theta), added as a LineString.
    origin: (latitude, longitude, turn) in degrees: where the map's (0, 0) lies on the Earth (WGS 84),
        and how far its x axis is turned from east to the left. Coordinates are longitude and
        latitude then; without it they are metres of the map frame.)")
      .def("to_svg", placedWriter(linesSvg), nb::arg("trajectory").none() = nb::none(),
           nb::arg("origin").none() = nb::none(),
           nb::sig("def to_svg(self, trajectory: numpy.typing.ArrayLike | None = None, "
                   "origin: collections.abc.Sequence[float] | None = None) -> str"),
           "Floor plan at 1 : 100 as SVG, with a scale bar and, where there is an origin, north. "
           "See\n`to_geojson` for the arguments.")
      .def(
          "_repr_svg_",
          [](SharedLineMap& map) {
            const LinesAndChains all = everything(map);
            return linesSvg(all.lines, all.poly_lines, {}, all.arcs);
          },
          "The floor plan, for notebooks.")
      .def("to_dxf", writer(linesDxf), nb::arg("trajectory").none() = nb::none(),
           nb::sig("def to_dxf(self, trajectory: numpy.typing.ArrayLike | None = None) -> str"),
           "Floor plan in metres as DXF of AutoCAD 2000. See `to_geojson` for the argument.")
      .def("__len__", count)
      .def("__repr__",
           [count](SharedLineMap& map) {
             return "LineMap(" + std::to_string(count(map)) + " lines)";
           })
      .def("__copy__", copyOf)
      .def(
          "__deepcopy__", [copyOf](SharedLineMap& map, nb::handle) { return copyOf(map); },
          nb::arg("memo"), nb::sig("def __deepcopy__(self, memo: object) -> LineMap"))
      .def(
          "to_csv",
          [](SharedLineMap& map) {
            return linesCsv(map.with([](LineMap& own) { return own.lines(); }));
          },
          "The lines as CSV, with the header that `cca-mrpt map` writes to lines.csv.");
}

void addPolyLine(nb::module_& module) {
  const auto make = [](PolyLine* self, nb::handle vertices, std::vector<std::uint64_t> line_ids) {
    PolyLine chain;
    for (const nb::handle vertex : nb::iter(vertices)) {
      double p[2];
      readNumbers(vertex, "vertices", "(x, y)", 2, p);
      chain.vertices.emplace_back(p[0], p[1]);
    }
    chain.line_ids = std::move(line_ids);
    new (self) PolyLine(std::move(chain));
  };
  nb::class_<PolyLine>(module, "PolyLine", "A chain of map lines; closed where first equals last.")
      .def("__init__", make, nb::arg("vertices"), nb::arg("line_ids"),
           nb::sig("def __init__(self, vertices: numpy.typing.ArrayLike, line_ids: "
                   "collections.abc.Sequence[int]) -> None"))
      .def_prop_ro(
          "vertices", [](const PolyLine& chain) { return pointArray(chain.vertices); },
          nb::sig("def vertices(self) -> numpy.typing.NDArray[numpy.float64]"),
          "(n, 2) m, map frame.")
      .def_prop_ro(
          "line_ids", [](const PolyLine& chain) { return chain.line_ids; },
          "Ids of the lines between neighbouring vertices.")
      .def("__len__", [](const PolyLine& chain) { return chain.vertices.size(); })
      .def("__repr__",
           [](const PolyLine& chain) {
             double length = 0.0;
             for (std::size_t k = 1; k < chain.vertices.size(); ++k)
               length += (chain.vertices[k] - chain.vertices[k - 1]).norm();
             const nb::str text =
                 nb::str("PolyLine({} vertices, {:.2f} m)").format(chain.vertices.size(), length);
             return std::string(text.c_str());
           })
      .def(
          "__reduce__",
          [](nb::handle self) {
            return nb::make_tuple(self.type(),
                                  nb::make_tuple(self.attr("vertices"), self.attr("line_ids")));
          },
          nb::sig("def __reduce__(self) -> tuple[typing.Any, ...]"));
}

}  // namespace

void addMapping(nb::module_& module) {
  static const std::string docs =
      parameterDocs<CcaParameters>(R"(Lines of one scan by consecutive clustering.

Args:
    ranges: (N,) m, beam by beam; +inf: no return; NaN, 0 and negative: invalid. float64 and float32
        arrays are read in place.
    angle_min: rad, bearing of beam 0 in the sensor frame, counter-clockwise.
    angle_increment: rad, from beam to beam; negative where the laser turns clockwise.

Returns:
    Structured array of dtype `LINE`, counter-clockwise, empty below three returns: `ends` (2, 2),
    [[x1, y1], [x2, y2]] in m, sensor frame; `covariance` (2, 2) of (lateral offset at the centroid of
    the returns [m], orientation [rad]); `returns`, number of laser returns.

Raises:
    ValueError: naming the argument.)");
  static const std::string signature = parameterSignature<CcaParameters>(
      "extract_lines(ranges: numpy.typing.ArrayLike, angle_min: float, angle_increment: float",
      kLines);
  module.def("extract_lines", &extract, nb::arg("ranges").none(), nb::arg("angle_min"),
             nb::arg("angle_increment"), nb::arg("parameters"), nb::sig(signature.c_str()),
             docs.c_str());
  addPolyLine(module);
  addLineMap(module);
}

}  // namespace cca::python
