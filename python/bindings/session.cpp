// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/session/mapping_session.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "apps/runs/on_all_cores.hpp"
#include "arguments.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/localisation/wheel_odometry.hpp"
#include "cca_mrpt/navigation/world/exploration_grid.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "io/files/stray_places.hpp"
#include "io/logs/measurements.hpp"
#include "io/logs/scan_cut_off.hpp"
#include "io/logs/sound_log.hpp"
#include "io/poses/local_frame.hpp"
#include "line_arrays.hpp"
#include "locked.hpp"
#include "map_files.hpp"
#include "module.hpp"
#include "owned_array.hpp"
#include "parameters.hpp"

namespace cca::python {
namespace {

/// The records of any Python iterator, for what reads logs.
class PythonLog : public LogReader {
 public:
  /// @param iterator  outlives this, which may be destroyed without the interpreter's lock.
  explicit PythonLog(nb::handle iterator) : iterator_(iterator) {}

  std::optional<LogRecord> next() override {
    const nb::gil_scoped_acquire turn;
    if (ended_) return std::nullopt;
    const nb::object record = nb::steal(PyIter_Next(iterator_.ptr()));
    if (record.is_valid()) {
      const LogRecord* taken = nullptr;
      if (!nb::try_cast<const LogRecord*>(record, taken) || !taken)
        throw nb::value_error("records: an iterable of LogRecord is needed");
      return *taken;
    }
    ended_ = true;
    if (PyErr_Occurred()) throw nb::python_error();
    return std::nullopt;
  }
  std::string warnings() const override { return {}; }
  double progress() const override { return ended_ ? 1.0 : 0.0; }

 private:
  nb::handle iterator_;
  bool ended_ = false;
};

/// Occupancy of the scans of a map, as the program's ScanGrid has it.
class CellRecorder : public MapRecorder {
 public:
  void restart() override { cells_ = ExplorationGrid(); }
  void record(const MappedScan& mapped, const LineMap& /*map*/) override {
    if (mapped.scan.size() >= 2 && fits(mapped.scan)) cells_.insert(cutOff(mapped.scan));
  }
  OccupancyRaster raster() const;

 private:
  /// A broken pose must not exhaust the memory.
  bool fits(const Scan& scan) const {
    if (!cells_.covers(scan.T_map_sensor.position())) return false;
    const Cell here = cells_.cellOf(scan.T_map_sensor.position());
    const double x = std::max<double>(std::abs(here.x - cells_.lowest().x),
                                      std::abs(here.x - cells_.highest().x));
    const double y = std::max<double>(std::abs(here.y - cells_.lowest().y),
                                      std::abs(here.y - cells_.highest().y));
    return cells_.revealed() == 0 || (x + kReach) * (y + kReach) < kMostCells;
  }
  static constexpr double kReach = 1000.0, kMostCells = 1e8;  // cells
  ExplorationGrid cells_;
};

OccupancyRaster CellRecorder::raster() const {
  OccupancyRaster raster;
  const Cell low = cells_.lowest(), high = cells_.highest();
  raster.resolution = cells_.resolution();
  if (high.x < low.x || high.y < low.y) return raster;
  raster.columns = high.x - low.x + 1;
  raster.rows = high.y - low.y + 1;
  raster.origin = raster.resolution * Eigen::Vector2d(low.x, low.y);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      const CellState state = cells_.at({x, y});
      const bool is_wall = state == CellState::kOccupied || state == CellState::kPresumedWall;
      raster.values.push_back(is_wall                     ? Occupancy::kOccupied
                              : state == CellState::kFree ? Occupancy::kFree
                                                          : Occupancy::kUnknown);
    }
  }
  return raster;
}

std::unique_ptr<Localiser> localiserOf(PoseSource source) {
  if (source == PoseSource::kSlam) return std::make_unique<SlamLocaliser>();
  if (source == PoseSource::kOdometry) return std::make_unique<WheelOdometry>();
  return std::make_unique<GivenPoses>();
}

/// @throws nb::value_error
PoseSource sourceOf(const std::string& name) {
  for (const PoseSource source : {PoseSource::kLog, PoseSource::kOdometry, PoseSource::kSlam}) {
    if (name == nameOf(source)) return source;
  }
  throw nb::value_error(("pose: '" + name + "' is none of auto log odometry slam").c_str());
}

/// A session, and what the files of its map need besides.
struct Mapping {
  Mapping(PoseSource source, const CcaParameters& parameters, bool maps_at_the_end) : pose(source) {
    auto localiser = localiserOf(source);
    slam = dynamic_cast<SlamLocaliser*>(localiser.get());
    MappingSession::Settings settings;
    settings.mapping = parameters;
    settings.maps_at_the_end = maps_at_the_end;
    session = std::make_unique<MappingSession>(std::move(localiser), settings, cells.get());
  }

  Estimate add(LogRecord record) {
    beams += record.scan.size();
    return session->add(measurementOf(std::move(record), pose));
  }

  PoseSource pose;
  SlamLocaliser* slam = nullptr;                                           ///< of the session
  std::unique_ptr<CellRecorder> cells = std::make_unique<CellRecorder>();  ///< the session's
  std::unique_ptr<MappingSession> session;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, map frame: where its frame lies
  std::size_t beams = 0;
  bool finished = false;
};
using SharedMapping = Locked<Mapping>;

MappedScans resultOf(const Mapping& mapping) {
  const MappingSession& session = *mapping.session;
  MappedScans result;
  result.map = {session.lineMap().lines(), session.lineMap().polyLines(), session.lineMap().arcs()};
  result.trajectory = session.trajectory();
  result.times = session.times();
  result.is_placed = session.isLocalised();
  result.distance = drivenLength(result.trajectory);
  if (mapping.slam) {
    const Slam& slam = mapping.slam->slam();
    result.graph = slam.keyFrames().graph;
    result.memory = {slam.memory(), mapping.origin};
    result.loops = slam.loops().size();
  }
  result.grid = mapping.cells->raster();
  result.pose = nameOf(mapping.pose);
  result.beams = mapping.beams;
  result.agreement = session.agreement().overall();
  result.origin = mapping.origin;
  result.finished = mapping.finished;
  return result;
}

nb::object mapLog(nb::handle records, const std::string& pose, nb::kwargs keywords) {
  CcaParameters parameters;
  readParameters(keywords, parameters);
  const nb::object iterator = nb::iter(records);
  auto reader = std::make_unique<PythonLog>(iterator);
  std::unique_ptr<Mapping> mapping;
  std::optional<MappedScans> result;
  const bool is_auto = pose == "auto";
  PoseSource source = is_auto ? PoseSource::kSlam : sourceOf(pose);
  try {
    const nb::gil_scoped_release others_may_run;
    LocalLog log(soundScansOf(std::move(reader)));
    if (is_auto && log.beginsCorrected()) source = PoseSource::kLog;
    mapping = std::make_unique<Mapping>(source, parameters, true);
    mapping->origin = log.origin();
    while (auto record = log.next()) mapping->add(std::move(*record));
    mapping->session->finish(apps::doOnAllCores);
    mapping->finished = true;
    result = resultOf(*mapping);
    result->warnings = log.warnings();
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
  return filesAndArrays(std::move(*result));
}

void constructMapper(SharedMapping* self, const std::string& pose, nb::kwargs keywords) {
  CcaParameters parameters;
  readParameters(keywords, parameters);
  new (self) SharedMapping(Mapping(sourceOf(pose), parameters, false));
}

Estimate stepMapper(SharedMapping& mapping, const LogRecord& record) {
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
    if (last_pass && !own.finished) {
      own.session->finish(apps::doOnAllCores);
      own.finished = true;
    }
    return resultOf(own);
  }));
}

void addEstimate(nb::module_& module) {
  nb::class_<Estimate>(module, "Estimate", "Where a scan was taken, as `Mapper.step` believes.")
      .def_prop_ro(
          "pose",
          [](const Estimate& e) {
            return nb::make_tuple(e.T_map_robot.x, e.T_map_robot.y, e.T_map_robot.theta);
          },
          nb::sig("def pose(self) -> tuple[float, float, float]"),
          "(x, y, theta) of the robot in the map frame; m, m, rad.")
      .def_prop_ro(
          "covariance",
          [](const Estimate& e) {
            auto numbers = std::make_unique<double[]>(9);
            std::copy_n(e.covariance.data(), 9, numbers.get());
            return ownedArray(std::move(numbers), 3, 3);
          },
          nb::sig("def covariance(self) -> numpy.typing.NDArray[numpy.float64]"),
          "(3, 3) of (x, y, theta) in the map's axes; 0 where nobody knows it.")
      .def_ro("agreement", &Estimate::agreement, "Of the scan with what was seen before, [0, 1].")
      .def_ro("is_placed", &Estimate::is_known, "Whether its place in the map is known.")
      .def_ro("was_corrected", &Estimate::was_corrected,
              "Whether the poses of the past, and with them the map, have changed with it.")
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
  static const std::string signature = parameterSignature<CcaParameters>(
      "map_records(records: collections.abc.Iterable[LogRecord], pose: str",
      "tuple[dict[str, typing.Any], dict[str, bytes]]");
  module.def("map_records", &mapLog, nb::arg("records"), nb::arg("pose"), nb::arg("parameters"),
             nb::sig(signature.c_str()),
             "What a map of scans holds, and its files by name: see `cca_mrpt.map`.");
  static const std::string construction =
      parameterSignature<CcaParameters>("__init__(self, pose: str", "None");
  nb::class_<SharedMapping>(module, "MappingSession",
                            "The pipeline from scans to a map: see `cca_mrpt.Mapper`.")
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
      .def("result", &resultOfMapper, nb::arg("last_pass"),
           nb::sig("def result(self, last_pass: bool) -> "
                   "tuple[dict[str, typing.Any], dict[str, bytes]]"));
}

}  // namespace cca::python
