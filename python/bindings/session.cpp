// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/session/mapping_session.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "apps/logs/session_warnings.hpp"
#include "apps/options/moved.hpp"
#include "apps/runs/on_all_cores.hpp"
#include "arguments.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/scan_raster.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/localisation/wheel_odometry.hpp"
#include "cca_mrpt/session/earlier_drive.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "io/files/memory_file.hpp"
#include "io/files/stray_places.hpp"
#include "io/logs/measurements.hpp"
#include "io/logs/sound_log.hpp"
#include "io/poses/local_frame.hpp"
#include "line_arrays.hpp"
#include "live/live_page.hpp"
#include "locked.hpp"
#include "map_files.hpp"
#include "module.hpp"
#include "owned_array.hpp"
#include "parameters.hpp"
#include "python_log.hpp"
#include "unpickled.hpp"

namespace cca::python {
namespace {

/// What is kept of the scans of a map beside it: occupancy, and what a page shows of a map that is
/// made at the end.
class ScanRecorder : public MapRecorder {
 public:
  /// @param title  of the replay, for people.
  explicit ScanRecorder(std::string title) : title_(std::move(title)), replay_(title_) {}

  void restart() override {
    raster_ = ScanRaster(p_begin_);
    replay_ = Replay(title_);
    last_moment_.reset();
    distance_ = 0.0;
    if (page_) page_->restart();
  }
  void record(const MappedScan& mapped, const LineMap& map) override {
    raster_.insert(mapped.scan);
    if (!is_replayed_ || mapped.is_of_earlier_drive) return;
    ReplayMoment moment;
    moment.time = told_[mapped.number].time;
    moment.distance = distance_;
    moment.T_map_robot = mapped.T_map_robot;
    moment.truth = told_[mapped.number].reference;
    if (page_ && page_->isDue()) page_->show({moment, mapped.scan, map, {}, {}});
    const std::optional<Pose2> last = last_moment_;
    if (!apps::keepIfMoved(last_moment_, mapped.T_map_robot)) return;
    const double step = last ? (mapped.T_map_robot.position() - last->position()).norm() : 0.0;
    if (step < apps::kLongestStep) distance_ += step;
    moment.distance = distance_;
    replay_.add(moment, mapped.scan, map);
  }
  std::optional<OccupancyRaster> raster() const { return raster_.raster(); }

  /// Before the first scan. @param p_begin  m: about where they begin.
  void beginAt(const Eigen::Vector2d& p_begin) {
    p_begin_ = p_begin;
    raster_ = ScanRaster(p_begin_);
  }
  /// Of the next scan. @param reference  the pose that the run can be judged by.
  void add(double seconds, const std::optional<Pose2>& reference) {
    told_.push_back({seconds, reference});
  }
  /// From now on, what is recorded can be looked at: of maps that are made once.
  void keepReplay() { is_replayed_ = true; }
  void showOn(LivePage* page) { page_ = page; }
  /// Replay::packed(); empty where there is none. @param lines  as the run leaves them.
  std::string replay(const std::vector<MapLine>& lines, const Eigen::Vector2d& origin) const {
    Replay replay = replay_;
    replay.finish(lines);
    return replay.empty() ? "" : replay.packed(origin);
  }

 private:
  std::optional<Eigen::Vector2d> p_begin_;
  ScanRaster raster_;
  /// What a log tells of a scan beside what is mapped.
  struct Telling {
    double time;  ///< s
    std::optional<Pose2> reference;
  };
  std::vector<Telling> told_;  ///< of each scan
  std::string title_;
  Replay replay_;
  bool is_replayed_ = false;
  std::optional<Pose2> last_moment_;
  double distance_ = 0.0;  ///< m, up to the last moment
  LivePage* page_ = nullptr;
};

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
  /// @param of_what  is recorded, for people.
  Mapping(PoseSource source, const CcaParameters& parameters, bool at_the_end,
          const std::string& of_what)
      : pose(source),
        title(of_what),
        recorder(std::make_unique<ScanRecorder>(of_what)),
        maps_at_the_end(at_the_end) {
    if (at_the_end) recorder->keepReplay();
    auto localiser = localiserOf(source);
    slam = dynamic_cast<SlamLocaliser*>(localiser.get());
    MappingSession::Settings settings;
    settings.mapping = parameters;
    settings.maps_at_the_end = maps_at_the_end;
    session = std::make_unique<MappingSession>(std::move(localiser), settings, recorder.get());
  }

  Estimate add(LogRecord record) {
    beams += record.scan.size();
    unguided += !record.odometry;
    ReplayMoment moment;
    moment.time = record.has_time ? record.time : 0.0;
    recorder->add(moment.time, referencePose(record));
    const Estimate estimate = session->add(measurementOf(std::move(record), pose));
    moment.T_map_robot = estimate.T_map_robot;
    if (page && page->isDue()) page->show({moment, session->scan(), session->lineMap(), {}, {}});
    return estimate;
  }

  /// Goes on with the map in a folder, before the first scan.
  void resume(const std::string& folder) {
    earlier = loadMemory(folder);
    resumed = folder;
    rememberDrive(earlier->memory, *slam, *session);
  }

  /// Another log begins: its drive may begin anywhere in the place of the first one.
  void beginDrive() {
    if (session->trajectory().empty()) return;
    session->beginDrive();
    if (slam) slam->startAnywhere();
  }

  void finish() {
    session->finish(apps::doOnAllCores);
    if (earlier && slam->slam().isInMemory()) origin = earlier->origin;
    finished = true;
    if (page) page->finish(session->lineMap().lines(), "all is mapped");
  }

  std::string serve(LivePageSettings settings) {
    settings.origin = origin;
    page = openLivePage(settings);
    if (maps_at_the_end) recorder->showOn(page.get());
    return page->url();
  }

  /// Whether a viewer of the page wants no more scans to be taken for now.
  bool isPaused() {
    while (const auto command = page ? page->nextCommand() : std::nullopt) {
      is_paused = command->kind != RunCommand::Kind::kStart;
      page->setPaused(is_paused);
    }
    return is_paused;
  }

  PoseSource pose;
  std::string title;
  SlamLocaliser* slam = nullptr;           ///< of the session
  std::unique_ptr<LivePage> page;          ///< null: none
  std::unique_ptr<ScanRecorder> recorder;  ///< the session's
  std::unique_ptr<MappingSession> session;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, map frame: where its frame lies
  std::size_t beams = 0, unguided = 0;               ///< of all scans; scans without odometry
  std::optional<StoredMemory> earlier;  ///< of earlier drives, that this one goes on with
  std::string resumed;                  ///< the folder that it is from
  bool maps_at_the_end, finished = false, is_paused = false;
};
using SharedMapping = Locked<Mapping>;

MappedScans resultOf(const Mapping& mapping) {
  const MappingSession& session = *mapping.session;
  const Slam* slam = mapping.slam ? &mapping.slam->slam() : nullptr;
  MappedScans result;
  MapProducts& products = result.products;
  products = mapProducts(mapping.title, session);
  products.origin = mapping.origin;
  products.grid = mapping.recorder->raster();
  products.replay = mapping.recorder->replay(products.lines, mapping.origin);
  result.is_placed = session.isLocalised();
  auto& summary = products.summary;
  if (!mapping.title.empty()) summary["title"] = mapping.title;
  summary["finished"] = mapping.finished;
  summary["pose"] = nameOf(mapping.pose);
  summary["scans"] = products.trajectory.size();
  summary["beams"] = mapping.beams;
  summary["distance_m"] = drivenLength(products.trajectory);
  summary["agreement"] = session.agreement().overall();
  if (slam) {
    products.graph = slam->keyFrames().graph;
    products.memory = packedMemory({slam->memory(), mapping.origin});
    summary["key_frames"] = products.graph.size();
    summary["loops"] = slam->loops().size();
  }
  if (mapping.earlier) {
    summary["resumed"] = mapping.resumed;
    summary["found_in_memory"] = slam->isInMemory();
  }
  result.warnings = apps::sessionWarnings(session, slam, mapping.pose, mapping.unguided,
                                          mapping.resumed, mapping.origin);
  result.shortcoming = apps::shortcomingOf(session, slam);
  return result;
}

/// Waits while a viewer wants it. With the interpreter's lock; @throws what Ctrl-C raises.
template <class IsPaused>
void waitForViewers(IsPaused&& is_paused) {
  while (is_paused()) {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    const nb::gil_scoped_release others_may_run;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

LivePageSettings pageAt(const std::string& address, int port, const std::string& title) {
  if (port < 0 || port > 65535) throw nb::value_error("port: must be in [0, 65535]");
  LivePageSettings settings;
  settings.address = address;
  settings.port = port;
  settings.title = title;
  return settings;
}

/// A log to map: its name, empty where it has none, and an iterable of its records.
using NamedLog = std::pair<std::string, nb::object>;

/// Goes through the logs that are mapped, one after the other, in the frame of the first.
class DrivesToMap {
 public:
  /// @param logs  one or more; outlive this.
  explicit DrivesToMap(const std::vector<NamedLog>& logs) : logs_(logs) {}

  /// The next log; null after the last. Without the interpreter's lock.
  std::unique_ptr<LocalLog> next() {
    if (number_ == logs_.size()) return nullptr;
    const NamedLog& named = logs_[number_++];
    {
      const nb::gil_scoped_acquire turn;
      iterator_ = nb::iter(named.second);
    }
    auto log = std::make_unique<LocalLog>(soundScansOf(std::make_unique<PythonLog>(iterator_)));
    if (number_ == 1) origin_ = log->origin();
    log->moveTo(origin_);
    return log;
  }

  /// What is wrong with the log that next() gave, or could not give.
  std::runtime_error named(const std::runtime_error& error) const {
    const std::string& name = logs_[number_ - 1].first;
    return std::runtime_error(name.empty() ? error.what() : name + ": " + error.what());
  }

 private:
  const std::vector<NamedLog>& logs_;
  nb::object iterator_;  ///< of the log that is being read
  std::size_t number_ = 0;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
};

/// A session that takes logs one after the other.
class LogMapping {
 public:
  LogMapping(const std::vector<NamedLog>& logs, PoseSource pose, const CcaParameters& parameters,
             const std::string& title)
      : drives_(logs), pose_(pose), parameters_(parameters), title_(title) {}

  /// Whether the log's own poses are taken where its first scan has corrected ones.
  bool prefers_corrected = false;
  std::optional<std::string> resumed;  ///< folder of a map to go on with
  /// Called with the session when it has been made.
  std::function<void(Mapping&)> begun = [](Mapping&) {};

  /// Maps all. Without the interpreter's lock.
  MappedScans run() {
    std::string warnings;
    while (takeNext(warnings)) continue;
    mapping_->finish();
    MappedScans result = resultOf(*mapping_);
    apps::appendWarning(result.warnings, warnings);
    result.warnings = warnings;
    return result;
  }

 private:
  /// @return  false after the last log.
  bool takeNext(std::string& warnings) {
    std::unique_ptr<LocalLog> log;
    try {
      log = drives_.next();
    } catch (const std::runtime_error& error) {
      throw drives_.named(error);
    }
    if (!log) return false;
    if (mapping_) {
      mapping_->beginDrive();
    } else {
      begin(*log);
    }
    try {
      take(*log);
    } catch (const std::runtime_error& error) {
      throw drives_.named(error);
    }
    apps::appendWarning(log->warnings(), warnings);
    return true;
  }

  void begin(const LocalLog& first) {
    if (prefers_corrected && first.beginsCorrected()) pose_ = PoseSource::kLog;
    mapping_ = std::make_unique<Mapping>(pose_, parameters_, true, title_);
    mapping_->origin = first.origin();
    mapping_->recorder->beginAt(first.start());
    if (resumed) mapping_->resume(*resumed);
    begun(*mapping_);
  }

  void take(LocalLog& log) {
    const auto isPaused = [this] { return mapping_->isPaused(); };
    while (auto record = log.next()) {
      if (isPaused()) {
        const nb::gil_scoped_acquire turn;
        waitForViewers(isPaused);
      }
      mapping_->add(std::move(*record));
    }
  }

  DrivesToMap drives_;
  PoseSource pose_;
  CcaParameters parameters_;
  std::string title_;
  std::unique_ptr<Mapping> mapping_;
};

/// @param resume  the folder of a map to go on with; nothing: none.
/// @param page    where a page is to be served; nothing: there is none.
/// @param told    called with its address.
nb::object mapLogs(const std::vector<NamedLog>& logs, const std::string& pose,
                   const std::optional<std::string>& resume, const std::string& title,
                   const std::optional<std::pair<std::string, int>>& page, nb::handle told,
                   nb::kwargs keywords) {
  CcaParameters parameters;
  readParameters(keywords, parameters);
  if (logs.empty()) throw nb::value_error("logs: one or more are needed");
  const bool is_auto = pose == "auto", is_joined = logs.size() > 1 || resume;
  const PoseSource source = is_auto ? PoseSource::kSlam : sourceOf(pose);
  if (source != PoseSource::kSlam && is_joined) {
    throw nb::value_error(
        ("pose: '" + pose + "': several logs, and logs with resume, are joined by 'slam'").c_str());
  }
  std::optional<LivePageSettings> served;
  if (page) served = pageAt(page->first, page->second, title);
  LogMapping mapping(logs, source, parameters, title);
  mapping.prefers_corrected = is_auto && !is_joined;
  mapping.resumed = resume;
  mapping.begun = [&](Mapping& own) {
    if (!served) return;
    const std::string url = own.serve(*served);
    const nb::gil_scoped_acquire turn;
    told(url);
  };
  std::optional<MappedScans> result;
  try {
    const nb::gil_scoped_release others_may_run;
    result = mapping.run();
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
  return filesAndArrays(*result);
}

nb::object mergeMaps(const std::vector<std::string>& maps, nb::kwargs keywords) {
  CcaParameters parameters;
  readParameters(keywords, parameters);
  if (maps.size() < 2) throw nb::value_error("maps: two or more are needed");
  std::optional<MappedScans> result;
  try {
    const nb::gil_scoped_release others_may_run;
    std::vector<StoredMemory> stored;
    for (const std::string& map : maps) stored.push_back(loadMemory(map));
    Mapping mapping(PoseSource::kSlam, parameters, true, "");
    mapping.origin = stored.front().origin;
    std::vector<const SlamMemory*> drives;
    for (const StoredMemory& map : stored) drives.push_back(&map.memory);
    const auto apart = joinDrives(drives, *mapping.slam, *mapping.session, apps::doOnAllCores);
    if (apart) {
      throw std::runtime_error(maps[*apart] + ": no place of it was found in " + maps.front());
    }
    mapping.finished = true;
    result = resultOf(mapping);
    result->products.graph = mapping.slam->slam().memory().graph;
    result->products.summary["key_frames"] = result->products.graph.size();
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
  return filesAndArrays(*result);
}

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
      "map_logs(logs: collections.abc.Sequence[tuple[str, collections.abc.Iterable[LogRecord]]], "
      "pose: str, "
      "resume: str | None, title: str, page: tuple[str, int] | None, told: "
      "collections.abc.Callable[[str], object]",
      "tuple[dict[str, typing.Any], dict[str, bytes]]");
  module.def("map_logs", &mapLogs, nb::arg("logs"), nb::arg("pose"), nb::arg("resume").none(),
             nb::arg("title"), nb::arg("page").none(), nb::arg("told"), nb::arg("parameters"),
             nb::sig(signature.c_str()),
             "What a map of logs holds, and its files by name: see `cca_mrpt.map`.");
  static const std::string merging =
      parameterSignature<CcaParameters>("merge_maps(maps: collections.abc.Sequence[str]",
                                        "tuple[dict[str, typing.Any], dict[str, bytes]]");
  module.def("merge_maps", &mergeMaps, nb::arg("maps"), nb::arg("parameters"),
             nb::sig(merging.c_str()),
             "What the map of several maps holds, and its files: see `cca_mrpt.merge`.");
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
