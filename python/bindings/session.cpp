// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/stl/string.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "arguments.hpp"
#include "line_arrays.hpp"
#include "locked.hpp"
#include "module.hpp"
#include "owned_array.hpp"
#include "parameters.hpp"
#include "scan_mapping.hpp"
#include "unpickled.hpp"

namespace cca::python {
namespace {

using SharedMapping = Locked<Mapping>;

void constructMapper(SharedMapping* self, const std::string& pose, nb::kwargs keywords) {
  CcaParameters parameters;
  readParameters(keywords, parameters);
  new (self) SharedMapping(Mapping(sourceOf(pose), parameters, false, ""));
}

Estimate stepMapper(SharedMapping& mapping, const LogRecord& record) {
  waitForViewers([&mapping] { return mapping.with([](Mapping& own) { return own.isPaused(); }); });
  try {
    return mapping.with([&record](Mapping& own) {
      if (own.finished) throw std::runtime_error("record: the mapper has finished");
      return own.add(record);
    });
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
}

nb::object resultOfMapper(SharedMapping& mapping, bool last_pass) {
  return filesAndArrays(mapping.with([last_pass](Mapping& own) {
    if (last_pass && !own.finished) own.finish();
    return resultOf(own);
  }));
}

std::string serveMapper(SharedMapping& mapping, const std::string& address, int port,
                        const std::string& title) {
  const LivePageSettings settings = pageAt(address, port, title);
  return mapping.with([&settings](Mapping& own) {
    if (own.page) throw std::runtime_error("it is served already, at " + own.page->url());
    return own.serve(settings);
  });
}

nb::object covarianceArray(const Estimate& e) {
  auto numbers = std::make_unique<double[]>(9);
  std::copy_n(e.covariance.data(), 9, numbers.get());
  return ownedArray(std::move(numbers), 3, 3);
}

nb::tuple poseTuple(const Estimate& e) {
  return nb::make_tuple(e.T_map_robot.x, e.T_map_robot.y, e.T_map_robot.theta);
}

/// What Python sees of it, to be pickled.
nb::tuple estimateState(const Estimate& e) {
  return nb::make_tuple(poseTuple(e), covarianceArray(e), e.agreement, e.is_known, e.was_corrected);
}

void restoreEstimate(Estimate& self, const nb::tuple& state) {
  Estimate e;
  e.T_map_robot = readPose(state[0], "pose");
  readNumbers(nb::object(state[1]).attr("ravel")(), "covariance", "(3, 3)", 9, e.covariance.data());
  e.agreement = nb::cast<double>(state[2]);
  e.is_known = nb::cast<bool>(state[3]);
  e.was_corrected = nb::cast<bool>(state[4]);
  new (&self) Estimate(e);
}

void addEstimate(nb::module_& module) {
  nb::class_<Estimate>(module, "Estimate", "Where a scan was taken, as `Mapper.step` believes.")
      .def_prop_ro("pose", &poseTuple, nb::sig("def pose(self) -> tuple[float, float, float]"),
                   "(x, y, theta) of the robot in the map frame; m, m, rad.")
      .def_prop_ro("covariance", &covarianceArray,
                   nb::sig("def covariance(self) -> numpy.typing.NDArray[numpy.float64]"),
                   "(3, 3) of (x, y, theta) in the map's axes; 0 where nobody knows it.")
      .def_ro("agreement", &Estimate::agreement, "Of the scan with what was seen before, [0, 1].")
      .def_ro("is_placed", &Estimate::is_known, "Whether its place in the map is known.")
      .def_ro("was_corrected", &Estimate::was_corrected,
              "Whether the poses of the past, and with them the map, have changed with it.")
      .def("__getstate__", &estimateState,
           nb::sig("def __getstate__(self) -> tuple[typing.Any, ...]"))
      .def("__setstate__", &restoreEstimate, nb::arg("state"),
           nb::sig("def __setstate__(self, state: tuple[typing.Any, ...]) -> None"))
      .def("__repr__", [](const Estimate& e) {
        const nb::str text =
            nb::str("Estimate(x={:.3f}, y={:.3f}, theta={:.4f}, agreement={:.3f})")
                .format(e.T_map_robot.x, e.T_map_robot.y, e.T_map_robot.theta, e.agreement);
        return std::string(text.c_str());
      });
}

}  // namespace

void addSession(nb::module_& module) {
  addEstimate(module);
  addLogMapping(module);
  static const std::string construction =
      parameterSignature<CcaParameters>("__init__(self, pose: str", "None");
  nb::class_<SharedMapping> mapping_type(
      module, "MappingSession", "The pipeline from scans to a map: see `cca_mrpt.Mapper`.");
  refusePickle(
      mapping_type,
      "a Mapper cannot be pickled: it is in the middle of a drive; pickle its map(), or save "
      "it and go on with it by cca_mrpt.map(log, resume=folder)");
  mapping_type
      .def("__init__", &constructMapper, nb::arg("pose"), nb::arg("parameters"),
           nb::sig(construction.c_str()))
      .def("step", &stepMapper, nb::arg("record"))
      .def(
          "lines",
          [](SharedMapping& mapping) {
            return lineArray(
                mapping.with([](Mapping& own) { return own.session->lineMap().lines(); }));
          },
          nb::sig("def lines(self) -> numpy.typing.NDArray[numpy.void]"))
      .def("scans",
           [](SharedMapping& mapping) {
             return mapping.with([](Mapping& own) { return own.session->trajectory().size(); });
           })
      .def("serve", &serveMapper, nb::arg("address"), nb::arg("port"), nb::arg("title"))
      .def("result", &resultOfMapper, nb::arg("last_pass"),
           nb::sig("def result(self, last_pass: bool) -> "
                   "tuple[dict[str, typing.Any], dict[str, bytes]]"));
}

}  // namespace cca::python
