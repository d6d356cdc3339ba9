// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "arguments.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/gzip_lines.hpp"
#include "io/logs/text_formats.hpp"
#include "locked.hpp"
#include "module.hpp"
#include "python_log.hpp"

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
    const std::string head = fileHead(path, kLogHead);
    if (head.empty()) throw std::runtime_error(path + ": is empty, or a damaged compressed file");
    auto log = openTextLog(path, head);
    if (!log) {
      throw std::runtime_error(path + ": not a log of a known kind (" + kTextLogKinds +
                               ", ROS bags; MRPT's logs are read by the program)");
    }
    new (self) Log(std::move(log));
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
}

LogRecord next(Log& log) {
  auto record = log.with([](std::unique_ptr<LogReader>& reader) { return reader->next(); });
  if (!record) throw nb::stop_iteration();
  return std::move(*record);
}

std::optional<SensorReading> readReading(nb::handle reading) {
  if (reading.is_none()) return std::nullopt;
  double time = 0.0;
  nb::object pose;
  if (nb::len(reading) != 2 || !nb::try_cast<double>(reading[0], time) || !std::isfinite(time)) {
    throw nb::value_error("motion: each is None, or a time and the pose of the laser then");
  }
  return SensorReading{readPose(reading[1], "motion"), time};
}

/// @param motion  None, or three: before, in the middle, after.
SweepMotion readMotion(nb::handle motion) {
  if (motion.is_none()) return {};
  if (nb::len(motion) != 3) throw nb::value_error("motion: before, in the middle, after: three");
  return {readReading(motion[1]), readReading(motion[0]), readReading(motion[2])};
}

nb::object motionOf(const LogRecord& record) {
  const SweepMotion& motion = record.motion;
  if (!motion.before && !motion.middle && !motion.after) return nb::none();
  const auto told = [](const std::optional<SensorReading>& reading) -> nb::object {
    if (!reading) return nb::none();
    return nb::make_tuple(reading->time, triple(reading->T_odom_sensor));
  };
  return nb::make_tuple(told(motion.before), told(motion.middle), told(motion.after));
}

void constructRecord(LogRecord* self, nb::handle ranges, double angle_min, double angle_increment,
                     std::optional<double> time, nb::handle odometry, nb::handle robot_pose,
                     nb::handle sensor_pose, nb::handle pose, double free_range_without_return,
                     double sweep_duration, nb::handle motion) {
  LogRecord record;
  record.is_judged = false;
  readScan(ranges, angle_min, angle_increment, record.scan);
  readPlace(nb::make_tuple(0.0, 0.0, 0.0), free_range_without_return, record.scan);
  record.has_time = time.has_value();
  record.time = time.value_or(0.0);
  if (!std::isfinite(record.time)) throw nb::value_error("time: a finite number is needed");
  record.T_robot_sensor = readPoseInRadians(sensor_pose, "sensor_pose");
  if (!std::isfinite(sweep_duration)) {
    throw nb::value_error("sweep_duration: a finite number is needed");
  }
  record.scan.sweep_duration = sweep_duration;
  record.motion = readMotion(motion);
  if (!odometry.is_none()) record.odometry = readPose(odometry, "odometry");
  if (!robot_pose.is_none()) record.corrected = readPose(robot_pose, "robot_pose");
  const Pose2 T_map_robot =
      record.corrected ? *record.corrected : record.odometry.value_or(Pose2());
  record.scan.T_map_sensor =
      pose.is_none() ? T_map_robot * record.T_robot_sensor : readPose(pose, "pose");
  new (self) LogRecord(std::move(record));
}

nb::object recordRanges(LogRecord& record) {
  std::vector<double>& ranges = record.scan.ranges;
  return nb::cast(nb::ndarray<nb::numpy, double, nb::ndim<1>>(ranges.data(), {ranges.size()},
                                                              nb::find(record)));
}

nb::tuple recordState(LogRecord& r) {
  return nb::make_tuple(recordRanges(r).attr("copy")(), r.scan.angle_min, r.scan.angle_increment,
                        r.has_time ? std::optional<double>(r.time) : std::nullopt,
                        triple(r.odometry), triple(r.corrected), triple(r.T_robot_sensor),
                        triple(r.scan.T_map_sensor), r.scan.free_range_without_return,
                        r.scan.sweep_duration, motionOf(r), r.is_judged);
}

void restoreRecord(LogRecord& self, const nb::tuple& state) {
  constructRecord(&self, state[0], nb::cast<double>(state[1]), nb::cast<double>(state[2]),
                  nb::cast<std::optional<double>>(state[3]), state[4], state[5], state[6], state[7],
                  nb::cast<double>(state[8]), nb::cast<double>(state[9]), state[10]);
  self.is_judged = nb::cast<bool>(state[11]);
}

std::string describeRecord(LogRecord& record) {
  const auto& ranges = record.scan.ranges;
  const auto returns = std::count_if(ranges.begin(), ranges.end(),
                                     [](double r) { return r > 0.0 && std::isfinite(r); });
  const nb::str text = nb::str("LogRecord({} beams, {} returns, time={:.3f})")
                           .format(ranges.size(), returns, record.time);
  return text.c_str();
}

/// Of a text or bytes.
std::string bytesOf(nb::handle content) {
  if (!nb::isinstance<nb::bytes>(content)) return nb::cast<std::string>(content);
  const auto bytes = nb::cast<nb::bytes>(content);
  return {bytes.c_str(), bytes.size()};
}

void addRecord(nb::module_& module) {
  nb::class_<LogRecord>(module, "LogRecord", R"(One laser scan of a log.

Args:
    ranges, angle_min, angle_increment, free_range_without_return: as in `LineMap.insert`.
    time: s, never falling; None: unknown.
    odometry: (x, y, theta) of the robot by its wheels, in any frame that stays; None: unknown.
    robot_pose: (x, y, theta) of the robot in the map frame, where somebody knows it.
    sensor_pose: (x, y, theta) of the laser in the robot's frame; m, m, rad.
    pose: (x, y, theta) of the laser in the map frame; None: by `robot_pose`, else `odometry`.
    sweep_duration: s, from the first beam to the last; negative where the last was the first in time; 0: of one
        instant, or not known: it is learned.
    motion: where the laser was before, in the middle and after the sweep, best at its ends: three of (time,
        (x, y, theta)) or None, in a frame in which the robot never leaps; None: by `odometry` and `time`.)")
      .def("__init__", &constructRecord, nb::arg("ranges").none(), nb::arg("angle_min"),
           nb::arg("angle_increment"), nb::kw_only(), nb::arg("time").none() = nb::none(),
           nb::arg("odometry").none() = nb::none(), nb::arg("robot_pose").none() = nb::none(),
           nb::arg("sensor_pose").none() = nb::make_tuple(0.0, 0.0, 0.0),
           nb::arg("pose").none() = nb::none(), nb::arg("free_range_without_return") = 0.0,
           nb::arg("sweep_duration") = 0.0, nb::arg("motion").none() = nb::none(),
           nb::sig("def __init__(self, ranges: numpy.typing.ArrayLike, angle_min: float, "
                   "angle_increment: float, *, time: float | None = None, odometry: "
                   "collections.abc.Sequence[float] | None = None, robot_pose: "
                   "collections.abc.Sequence[float] | None = None, sensor_pose: "
                   "collections.abc.Sequence[float] = (0.0, 0.0, 0.0), pose: "
                   "collections.abc.Sequence[float] | None = None, free_range_without_return: "
                   "float = 0.0, sweep_duration: float = 0.0, motion: "
                   "collections.abc.Sequence[tuple[float, collections.abc.Sequence[float]] | "
                   "None] | None = None) -> None"))
      .def("__getstate__", &recordState,
           nb::sig("def __getstate__(self) -> tuple[typing.Any, ...]"))
      .def("__setstate__", &restoreRecord, nb::arg("state"),
           nb::sig("def __setstate__(self, state: tuple[typing.Any, ...]) -> None"))
      .def("__len__", [](const LogRecord& record) { return record.scan.ranges.size(); })
      .def("__repr__", &describeRecord)
      .def_prop_ro("ranges", &recordRanges,
                   nb::sig("def ranges(self) -> numpy.typing.NDArray[numpy.float64]"),
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
      .def_prop_ro(
          "sensor_pose", [](const LogRecord& record) { return triple(record.T_robot_sensor); },
          "(x, y, theta) of the laser in the robot's frame; m, m, rad.")
      .def_prop_ro(
          "free_range_without_return",
          [](const LogRecord& record) { return record.scan.free_range_without_return; },
          "m, up to which a beam without return is known to be free; 0: it tells nothing.")
      .def_prop_ro(
          "sweep_duration", [](const LogRecord& record) { return record.scan.sweep_duration; },
          "s, from the first beam to the last; 0 where the log does not tell.")
      .def_prop_ro("motion", &motionOf,
                   nb::sig("def motion(self) -> tuple[tuple[float, tuple[float, float, float]] | "
                           "None, ...] | None"),
                   "Of the laser before, in the middle and after the sweep; None: not told.")
      .def_ro("time", &LogRecord::time, "s; 0 where the log does not tell.");
}

}  // namespace

void addLogs(nb::module_& module) {
  addRecord(module);
  nb::class_<MissingReturns>(module, "MissingReturns",
                             "Learns what it means when a beam of one laser does not return.")
      .def(nb::init<>())
      .def(
          "judge", &judgeOnce, nb::arg("record"),
          "Judge a scan by those before it: beams that were lost become NaN, and\n"
          "`free_range_without_return` 0 where a missing return tells nothing of free space. Once: "
          "what a log\ngives is judged already, and `Mapper.step` judges what is not.");
  nb::class_<Log>(module, "TextLog",
                  "The scans of a log that is text, one after the other, once; see `read_log`.")
      .def("__init__", &open, nb::arg("path"))
      .def(
          "__iter__", [](nb::handle self) { return nb::borrow(self); },
          nb::sig("def __iter__(self) -> TextLog"))
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
          writeFile(folder + "/" + nb::cast<std::string>(name), bytesOf(content));
      },
      nb::arg("folder"), nb::arg("files"),
      nb::sig("def write_files_into(folder: str, files: collections.abc.Mapping[str, str | bytes]) "
              "-> None"),
      "Write texts by file name, each whole or not at all; the folder is made where it is "
      "missing.");
}

}  // namespace cca::python
