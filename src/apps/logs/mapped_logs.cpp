// SPDX-License-Identifier: BSD-3-Clause
#include "mapped_logs.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "apps/options/moved.hpp"
#include "apps/runs/on_all_cores.hpp"
#include "apps/runs/progress.hpp"
#include "cca_mrpt/session/earlier_drive.hpp"
#include "io/files/stray_places.hpp"
#include "io/files/text.hpp"
#include "io/poses/trajectory_error.hpp"
#include "session_warnings.hpp"
#include "slam/loop_review.hpp"

namespace cca::apps {
namespace {

std::string fileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

MappedLogs::MappedLogs(const LogsToMap& logs, const LocalLog& first, const Parameters& parameters)
    : logs_(logs),
      parameters_(parameters),
      start_(first.start()),
      origin_(first.origin()),
      background_(std::make_unique<BackgroundWork>()) {
  auto localiser = makeLocaliser(logs_.pose, parameters_.icp);
  slam_ = dynamic_cast<SlamLocaliser*>(localiser.get());
  MappingSession::Settings settings;
  settings.mapping = parameters_.mapping;
  settings.maps_at_the_end = true;
  settings.sweep = logs_.sweep;
  session_ = std::make_unique<MappingSession>(
      std::move(localiser), settings, this,
      [this](std::function<void()> work) { background_->add(std::move(work)); });
  if (logs_.memory) rememberDrive(logs_.memory->memory, *slam_, *session_);
  MappedLogs::restart();
}

void MappedLogs::take(const std::string& path, LocalLog& log,
                      const Interruption& interruption) try {
  log.moveTo(origin_);
  Progress progress(slam_ ? "locate" : "map");
  // A drive begins where its log does, for then its errors can be told; a second one anywhere.
  if (scans() > 0) session_->beginDrive();
  if (slam_ && scans() > 0) slam_->startAnywhere();
  while (!interrupted_) {
    heedCommands(interruption);
    std::optional<LogRecord> record = log.next();
    if (!record) break;
    beams_ += record->scan.size();
    unguided_ += !record->odometry;
    const Telling told{record->has_time ? record->time : 0.0, referencePose(*record)};
    background_->add([this, told] { told_.push_back(told); });
    const Estimate estimate = session_->add(measurementOf(std::move(*record), logs_.pose));
    if (slam_ && page_ && page_->isDue()) {  // it maps at the end: there are no lines until then
      ReplayMoment moment;
      moment.time = told.time;
      moment.T_map_robot = estimate.T_map_robot;
      show(moment, session_->scan(), session_->lineMap());
    }
    progress.show(
        log.progress(),
        std::to_string(scans()) + " scans" +
            (slam_ ? ", " + std::to_string(slam_->slam().loopsClosed()) + " loops closed" : ""));
    interrupted_ = interruption.requested();
  }
  appendWarning(log.warnings(), warnings_);
} catch (const std::runtime_error& error) {
  throw std::runtime_error(path + ": " + error.what());
}

void MappedLogs::show(const ReplayMoment& moment, const Scan& scan, const LineMap& map) {
  page_->show({moment, scan, map, {}, [this] { return mapProducts("", *session_); }});
}

/// Who pauses stops the reading; what was read is mapped on.
void MappedLogs::heedCommands(const Interruption& interruption) {
  bool is_paused = false;
  while (page_ && !interruption.requested()) {
    const std::optional<RunCommand> command = page_->nextCommand();
    if (!command && !is_paused) return;
    if (command) {
      is_paused = command->kind != RunCommand::Kind::kStart;
      page_->setPaused(is_paused);
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
}

void MappedLogs::finish() {
  if (interrupted_) {
    session_->mapAsItIs();
  } else {
    session_->finish(doOnAllCores);
  }
  background_->wait();
  if (logs_.memory && slam_->slam().isInMemory()) origin_ = logs_.memory->origin;
  appendWarning(sessionWarnings(*session_, slam(), logs_.pose, unguided_, logs_.resumed, origin_),
                warnings_);
}

std::string MappedLogs::shortcoming() const { return shortcomingOf(*session_, slam()); }

void MappedLogs::restart() {
  grid_ = ScanRaster(start_);
  replay_ = Replay(fileName(logs_.paths.front()));
  last_moment_.reset();
  distance_ = 0.0;
  if (page_) page_->restart();
}

void MappedLogs::record(const MappedScan& mapped, const LineMap& map) {
  grid_.insert(mapped.scan);
  if (mapped.is_of_earlier_drive) return;
  ReplayMoment moment;
  moment.time = told_[mapped.number].time;
  moment.distance = distance_;
  moment.T_map_robot = mapped.T_map_robot;
  moment.truth = told_[mapped.number].reference;
  if (page_ && page_->isDue()) show(moment, mapped.scan, map);
  const std::optional<Pose2> last = last_moment_;
  if (!keepIfMoved(last_moment_, mapped.T_map_robot)) return;
  const double step = last ? (mapped.T_map_robot.position() - last->position()).norm() : 0.0;
  if (step < kLongestStep) distance_ += step;
  moment.distance = distance_;
  replay_.add(moment, mapped.scan, map);
}

MapProducts MappedLogs::products() const {
  MapProducts products = mapProducts(fileName(logs_.paths.front()), *session_);
  products.grid = grid_.raster();
  products.origin = origin_;
  Replay replay = replay_;
  replay.finish(products.lines);
  products.replay = replay.empty() ? "" : replay.packed(origin_);
  auto& summary = products.summary;
  summary["program"] = "cca-mrpt " CCA_VERSION;
  if (logs_.paths.size() == 1) {
    summary["log"] = logs_.paths.front();
  } else {
    summary["logs"] = logs_.paths;
  }
  summary["finished"] = !interrupted_;
  summary["pose"] = nameOf(logs_.pose);
  summary["scans"] = scans();
  summary["beams"] = beams_;
  summary["distance_m"] = drivenLength(products.trajectory);
  summary["agreement"] = session_->agreement().overall();
  if (slam_) {
    const Slam& slam = slam_->slam();
    const std::vector<bool>& known = session_->isLocalised();
    products.graph = slam.graph();
    products.memory = packedMemory({slam.memory(), origin_});
    summary["key_frames"] = products.graph.size();
    summary["loops"] = slam.loopsClosed();
    addVisits(summary, slam.review());
    summary["scans_without_place"] = std::count(known.begin(), known.end(), false);
    if (logs_.memory) {
      summary["resumed"] = logs_.resumed;
      summary["found_in_memory"] = slam.isInMemory();
    }
  }
  std::string warnings = warnings_;
  appendWarning(shortcoming(), warnings);
  if (!warnings.empty()) summary["warnings"] = warnings;
  std::vector<std::string> used{"mapping"};
  if (logs_.pose == PoseSource::kIcp) used.push_back("icp");
  summary["parameters"] = parametersJson(parameters_, used);
  // Poses taken from the log are their own reference, and would be called perfect.
  if (logs_.pose != PoseSource::kLog && logs_.pose != PoseSource::kTruth) addPoseError(summary);
  return products;
}

/// How far the visits of a place contradict one another, and what was chosen among.
void MappedLogs::addVisits(nlohmann::ordered_json& summary, const LoopReview& review) {
  summary["visits_contradicted"] = review.agreement.excess();
  if (review.hypotheses == 0) return;
  auto& tried = summary["loop_hypotheses"];
  tried["solved"] = review.hypotheses;
  tried["changed"] = review.has_changed;
  if (!review.runner_up) return;
  tried["runner_up"] = {{"visits_contradicted", review.runner_up->excess},
                        {"distance_m", review.runner_up->distance}};
}

void MappedLogs::addPoseError(nlohmann::ordered_json& summary) const {
  std::vector<Pose2> judged, reference;
  for (std::size_t k = 0; k < told_.size(); ++k) {
    if (!told_[k].reference) continue;
    judged.push_back(session_->trajectory()[k]);
    reference.push_back(*told_[k].reference);
  }
  if (reference.empty()) return;
  const TrajectoryError error = compareTrajectories(judged, reference);
  summary["pose_error"] = {{"rms_m", error.rms_m},
                           {"max_m", error.max_m},
                           {"rms_deg", error.rms_deg},
                           {"at_end_m", error.at_end_m}};
}

}  // namespace cca::apps
