// SPDX-License-Identifier: BSD-3-Clause
#include "mapped_logs.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "cca_mrpt/io/pose_source.hpp"
#include "cca_mrpt/io/stray_places.hpp"
#include "cca_mrpt/io/trajectory_error.hpp"
#include "contradiction.hpp"
#include "moved.hpp"
#include "on_all_cores.hpp"
#include "progress.hpp"

namespace cca::apps {
namespace {

constexpr double kLongestStep = 10.0;  // m; farther from one scan to the next is no drive

std::string fileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// Of the poses that have not gone astray.
double pathLength(const std::vector<Pose2>& trajectory) {
  const std::vector<bool> stray = findStrays(trajectory);
  const Pose2* last = nullptr;
  double length = 0.0;
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    if (stray[k]) continue;
    if (last) length += (trajectory[k].position() - last->position()).norm();
    last = &trajectory[k];
  }
  return length;
}

}  // namespace

MappedLogs::MappedLogs(const LogsToMap& logs, const LocalLog& first, const CcaParameters& mapping)
    : logs_(logs),
      map_(mapping),
      grid_(first.start()),
      origin_(first.origin()),
      replay_(fileName(logs.paths.front())),
      drawing_(std::make_unique<BackgroundWork>()) {}

void MappedLogs::take(const std::string& path, LocalLog& log, const IcpParameters& icp,
                      const Interruption& interruption) try {
  log.moveTo(origin_);
  std::string of_poses;
  if (logs_.pose == "slam") {
    locateBySlam(log, interruption);
  } else {
    of_poses = locateScanByScan(log, icp, interruption);
  }
  warn(log.warnings());
  warn(of_poses);
} catch (const std::runtime_error& error) {
  throw std::runtime_error(path + ": " + error.what());
}

std::string MappedLogs::locateScanByScan(LocalLog& log, const IcpParameters& icp,
                                         const Interruption& interruption) {
  PoseSource poses(poseKind(logs_.pose), icp);
  Progress progress("map");
  while (auto record = log.next()) {
    const Pose2 T_map_robot = poses.place(*record);
    insert(*record, T_map_robot);
    progress.show(log.progress(), std::to_string(trajectory_.size()) + " scans");
    interrupted_ = interruption.requested();
    if (interrupted_) break;
  }
  return poses.warnings();
}

/// Line SLAM: all logs are gone through before the first line is drawn. It begins where the first
/// log does, for then its errors can be told; a second one may begin anywhere.
void MappedLogs::locateBySlam(LocalLog& log, const Interruption& interruption) {
  Progress progress("locate");
  if (slam_) slam_->startAnywhere();
  while (auto record = log.next()) {
    if (!slam_) {
      slam_.emplace(referencePose(*record).value_or(logPose(*record)));
      if (logs_.memory) slam_->remember(logs_.memory->memory);
    }
    slam_->step(record->scan, record->T_robot_sensor, record->odometry);
    records_.push_back(std::move(*record));
    progress.show(log.progress(), std::to_string(records_.size()) + " scans, " +
                                      std::to_string(slam_->loops().size()) + " loops closed");
    interrupted_ = interruption.requested();
    if (interrupted_) break;
  }
}

void MappedLogs::finish() {
  if (slam_) {
    if (!interrupted_) slam_->finish(doOnAllCores);
    const std::vector<bool> is_placed = slam_->isPlaced();
    const std::vector<Pose2> poses = slam_->trajectory();
    const auto remembered = static_cast<std::size_t>(slam_->remembered());
    if (remembered > 0 && slam_->isInMemory()) insertMemory(poses);
    for (std::size_t k = 0; k < records_.size(); ++k) {
      const Pose2& T_map_robot = poses[remembered + k];
      records_[k].scan.T_map_sensor = T_map_robot * records_[k].T_robot_sensor;
      insert(records_[k], T_map_robot, is_placed[remembered + k]);
    }
    warn(tellOfSlam({is_placed.begin() + slam_->remembered(), is_placed.end()}));
  }
  drawing_->wait();
  drawing_.reset();
  warn(straysTold());
  warn(contradiction(agreement_));
}

/// The map of the earlier drives, in whose frame this one has been found.
void MappedLogs::insertMemory(const std::vector<Pose2>& T_map_robot) {
  origin_ = logs_.memory->origin;
  const auto& keys = logs_.memory->memory.scans;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    Scan scan = keys[k].scan;
    scan.T_map_sensor = T_map_robot[k] * keys[k].T_robot_sensor;
    draw(scan);
  }
}

void MappedLogs::draw(const Scan& scan) {
  drawing_->add([this, scan] {
    agreement_.add(compareWithMap(scan, map_.walls()));
    map_.insert(scan);
  });
  grid_.insert(scan);
}

void MappedLogs::addMoment(const LogRecord& record, const Pose2& T_map_robot) {
  const std::optional<Pose2> last = last_moment_;
  if (!keepIfMoved(last_moment_, T_map_robot)) return;
  const double step = last ? (T_map_robot.position() - last->position()).norm() : 0.0;
  if (step < kLongestStep) distance_ += step;
  ReplayMoment moment;
  moment.time = record.time;
  moment.distance = distance_;
  moment.T_map_robot = T_map_robot;
  moment.truth = referencePose(record);
  drawing_->add([this, moment, scan = record.scan] { replay_.add(moment, scan, map_); });
}

void MappedLogs::insert(const LogRecord& record, const Pose2& T_map_robot, bool is_placed) {
  if (is_placed) draw(record.scan);
  unplaced_ += !is_placed;
  beams_ += record.scan.size();
  trajectory_.push_back(T_map_robot);
  times_.push_back(record.has_time ? record.time : 0.0);
  addMoment(record, T_map_robot);
  if (const auto reference = referencePose(record)) {
    judged_.push_back(T_map_robot);
    reference_.push_back(*reference);
  }
}

/// What SLAM had to do without.
std::string MappedLogs::tellOfSlam(const std::vector<bool>& is_placed) const {
  std::string told;
  const auto tell = [&](const std::string& more) { told += (told.empty() ? "" : "; ") + more; };
  if (!slam_->isInMemory()) {
    tell("no place of " + logs_.resumed + " was found: this is the map of the log alone");
  }
  if (unplaced_ > 0) {
    const auto first = std::find(is_placed.begin(), is_placed.end(), false) - is_placed.begin();
    tell("the place of " + std::to_string(unplaced_) +
         " scan(s) is not known, and they are in no map; the first is number " +
         std::to_string(first));
  }
  const auto without = std::count_if(records_.begin(), records_.end(),
                                     [](const LogRecord& record) { return !record.odometry; });
  if (without > 0) {
    tell(std::to_string(without) + " scan(s) without odometry, located by the laser alone");
  }
  return told;
}

/// "1 scan(s) far from all others, the first is number 12 at 1e+07, 3.2 m"; empty where there is
/// none.
std::string MappedLogs::straysTold() const {
  const std::vector<bool> stray = findStrays(trajectory_);
  const auto count = std::count(stray.begin(), stray.end(), true);
  if (count == 0) return "";
  const auto first =
      static_cast<std::size_t>(std::find(stray.begin(), stray.end(), true) - stray.begin());
  const Eigen::Vector2d place = origin_ + trajectory_[first].position();
  char text[160];
  std::snprintf(text, sizeof text,
                "%td scan(s) far from all others, the first is number %zu at %.9g, %.9g m", count,
                first, place.x(), place.y());
  return text;
}

void MappedLogs::warn(const std::string& warning) {
  if (!warnings_.empty() && !warning.empty()) warnings_ += "; ";
  warnings_ += warning;
}

MapProducts MappedLogs::products(const Parameters& parameters) const {
  MapProducts products;
  products.title = fileName(logs_.paths.front());
  products.lines = map_.lines();
  products.poly_lines = map_.polyLines();
  products.arcs = map_.arcs();
  products.trajectory = trajectory_;
  products.times = times_;
  products.grid = grid_.grid();
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
  summary["pose"] = logs_.pose;
  summary["scans"] = trajectory_.size();
  summary["beams"] = beams_;
  summary["distance_m"] = pathLength(trajectory_);
  summary["agreement"] = agreement_.overall();
  if (slam_) {
    products.graph = slam_->keyFrames().graph;
    products.memory = packedMemory({slam_->memory(), origin_});
    summary["key_frames"] = products.graph.size();
    summary["loops"] = slam_->loops().size();
    summary["scans_without_place"] = unplaced_;
    if (logs_.memory) {
      summary["resumed"] = logs_.resumed;
      summary["found_in_memory"] = slam_->isInMemory();
    }
  }
  if (!warnings_.empty()) summary["warnings"] = warnings_;
  std::vector<std::string> used{"mapping"};
  if (logs_.pose == "icp") used.push_back("icp");
  summary["parameters"] = parametersJson(parameters, used);
  // Poses taken from the log are their own reference, and would be called perfect.
  if (logs_.pose != "log" && logs_.pose != "truth" && !reference_.empty()) {
    const TrajectoryError error = compareTrajectories(judged_, reference_);
    summary["pose_error"] = {{"rms_m", error.rms_m},
                             {"max_m", error.max_m},
                             {"rms_deg", error.rms_deg},
                             {"at_end_m", error.at_end_m}};
  }
  return products;
}

}  // namespace cca::apps
