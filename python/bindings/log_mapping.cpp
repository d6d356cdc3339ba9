// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "apps/logs/session_warnings.hpp"
#include "apps/runs/interruption.hpp"
#include "arguments.hpp"
#include "cca_mrpt/session/earlier_drive.hpp"
#include "io/files/text.hpp"
#include "io/logs/sound_log.hpp"
#include "io/poses/local_frame.hpp"
#include "parameters.hpp"
#include "python_log.hpp"
#include "scan_mapping.hpp"

namespace cca::python {
namespace {

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
  std::optional<std::string> resumed;                ///< folder of a map to go on with
  const apps::Interruption* interruption = nullptr;  ///< ends the reading; null: nothing does
  /// Called with the session when it has been made.
  std::function<void(Mapping&)> begun = [](Mapping&) {};

  /// Maps all. Without the interpreter's lock.
  MappedScans run() {
    std::string warnings;
    while (!isInterrupted() && takeNext(warnings)) continue;
    if (isInterrupted()) {
      apps::tellOfSaving();
      mapping_->stop();
    } else {
      mapping_->listening([this] { mapping_->finish(); });
    }
    MappedScans result = resultOf(*mapping_);
    appendWarning(result.warnings, warnings);
    result.warnings = warnings;
    return result;
  }

 private:
  bool isInterrupted() const { return interruption && interruption->requested(); }

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
    appendWarning(log->warnings(), warnings);
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
    const auto isPaused = [this] { return !isInterrupted() && mapping_->isPaused(); };
    // One scan is mapped always.
    for (auto record = log.next(); record; record = isInterrupted() ? std::nullopt : log.next()) {
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
/// @param origin  (latitude, longitude, turn) of the map, degrees; None: nobody says.
/// @param page    where a page is to be served; nothing: there is none.
/// @param told    called with its address.
/// @param until_interrupted  Ctrl-C ends the reading instead of raising KeyboardInterrupt.
nb::object mapLogs(const std::vector<NamedLog>& logs, const std::string& pose,
                   const std::optional<std::string>& resume, const std::string& title,
                   nb::handle origin, const std::optional<std::pair<std::string, int>>& page,
                   nb::handle told, bool until_interrupted, nb::kwargs keywords) {
  CcaParameters parameters;
  readParameters(keywords, parameters);
  const std::optional<GeoReference> place = readOrigin(origin);
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
    std::optional<apps::Interruption> interruption;
    if (until_interrupted) mapping.interruption = &interruption.emplace();
    result = mapping.run();
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
  result->products.place = place;
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
    mapping.listening([&] {
      const auto apart = joinDrives(drives, *mapping.slam, *mapping.session, mapping.doAll());
      if (apart) {
        throw std::runtime_error(maps[*apart] + ": no place of it was found in " + maps.front());
      }
      mapping.complete();
    });
    result = resultOf(mapping);
    result->products.graph = mapping.slam->slam().memory().graph;
    result->products.summary["key_frames"] = result->products.graph.size();
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
  return filesAndArrays(*result);
}

}  // namespace

void addLogMapping(nb::module_& module) {
  static const std::string signature = parameterSignature<CcaParameters>(
      "map_logs(logs: collections.abc.Sequence[tuple[str, collections.abc.Iterable[LogRecord]]], "
      "pose: str, "
      "resume: str | None, title: str, origin: collections.abc.Sequence[float] | None, page: "
      "tuple[str, int] | None, told: "
      "collections.abc.Callable[[str], object], until_interrupted: bool",
      "tuple[dict[str, typing.Any], dict[str, bytes]]");
  module.def("map_logs", &mapLogs, nb::arg("logs"), nb::arg("pose"), nb::arg("resume").none(),
             nb::arg("title"), nb::arg("origin").none(), nb::arg("page").none(), nb::arg("told"),
             nb::arg("until_interrupted"), nb::arg("parameters"), nb::sig(signature.c_str()),
             "What a map of logs holds, and its files by name: see `cca_mrpt.map`.");
  static const std::string merging =
      parameterSignature<CcaParameters>("merge_maps(maps: collections.abc.Sequence[str]",
                                        "tuple[dict[str, typing.Any], dict[str, bytes]]");
  module.def("merge_maps", &mergeMaps, nb::arg("maps"), nb::arg("parameters"),
             nb::sig(merging.c_str()),
             "What the map of several maps holds, and its files: see `cca_mrpt.merge`.");
}

}  // namespace cca::python
