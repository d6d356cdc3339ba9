// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>

#include <stdexcept>

#include "carmen_reader.hpp"
#include "cca_mrpt/io/atomic_file.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "locked.hpp"
#include "module.hpp"

namespace cca::python {
namespace {

namespace nb = nanobind;

using Log = Locked<std::unique_ptr<LogReader>>;
using Triple = std::tuple<double, double, double>;

Triple triple(const Pose2& pose) { return {pose.x, pose.y, pose.theta}; }
std::optional<Triple> triple(const std::optional<Pose2>& pose) {
  return pose ? std::optional<Triple>(triple(*pose)) : std::nullopt;
}

void open(Log* self, const std::string& path) {
  try {
    const nb::gil_scoped_release others_may_run;
    new (self) Log(openCarmenLog(path));
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
}

LogRecord next(Log& log) {
  auto record = log.with([](std::unique_ptr<LogReader>& reader) { return reader->next(); });
  if (!record) throw nb::stop_iteration();
  return std::move(*record);
}

void addRecord(nb::module_& module) {
  nb::class_<LogRecord>(module, "LogRecord", "One laser scan of a log.")
      .def_prop_ro(
          "ranges",
          [](LogRecord& record) {
            std::vector<double>& ranges = record.scan.ranges;
            return nb::ndarray<nb::numpy, double, nb::ndim<1>>(ranges.data(), {ranges.size()},
                                                               nb::find(record));
          },
          nb::sig("def ranges(self) -> numpy.ndarray"),
          "(N,) m; +inf: no return; 0: invalid. The record's own memory.")
      .def_prop_ro(
          "angle_min", [](const LogRecord& record) { return record.scan.angle_min; },
          "rad, bearing of beam 0 in the sensor frame.")
      .def_prop_ro(
          "angle_increment", [](const LogRecord& record) { return record.scan.angle_increment; },
          "rad, from beam to beam.")
      .def_prop_ro(
          "pose", [](const LogRecord& record) { return triple(record.scan.T_map_sensor); },
          "(x, y, theta) of the sensor in the map frame, as the log has it; m, m, rad.")
      .def_prop_ro(
          "robot_pose", [](const LogRecord& record) { return triple(record.corrected); },
          "(x, y, theta) of the robot in the map frame, or None.")
      .def_prop_ro(
          "odometry", [](const LogRecord& record) { return triple(record.odometry); },
          "(x, y, theta) of the robot by odometry, or None.")
      .def_ro("time", &LogRecord::time, "s; 0 where the log does not tell.");
}

}  // namespace

void addLogs(nb::module_& module) {
  addRecord(module);
  nb::class_<Log>(module, "Log", "The scans of a log, one after the other.")
      .def("__init__", &open, nb::arg("path"))
      .def(
          "__iter__", [](nb::handle self) { return nb::borrow(self); },
          nb::sig("def __iter__(self) -> Log"))
      .def("__next__", &next)
      .def_prop_ro(
          "progress",
          [](Log& log) {
            return log.with([](std::unique_ptr<LogReader>& reader) { return reader->progress(); });
          },
          "How much of the log has been read, in [0, 1].")
      .def_prop_ro(
          "warnings",
          [](Log& log) {
            return log.with([](std::unique_ptr<LogReader>& reader) { return reader->warnings(); });
          },
          "What could not be read; empty where all was well.");
  module.def(
      "write_files_into",
      [](const std::string& folder, const nb::dict& files) {
        makeFolder(folder);
        for (const auto [name, content] : files)
          writeFile(folder + "/" + nb::cast<std::string>(name), nb::cast<std::string>(content));
      },
      nb::arg("folder"), nb::arg("files"),
      "Write texts by file name, each whole or not at all; the folder is made where it is "
      "missing.");
}

}  // namespace cca::python
