// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "cca_mrpt/io/local_frame.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/pose_source.hpp"
#include "cca_mrpt/io/scan_grid.hpp"
#include "cca_mrpt/io/stray_places.hpp"
#include "cca_mrpt/io/trajectory_error.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/slam/slam.hpp"
#include "commands.hpp"
#include "interruption.hpp"
#include "log_warnings.hpp"
#include "parameter_options.hpp"
#include "progress.hpp"

namespace cca::apps {
namespace {

struct MapOptions {
  std::string log, out, pose;  // no pose source named: see makeMap()
  bool force = false, quiet = false;
};

/// What is kept of a log while it is mapped.
struct MappedLog {
  LineMap map;
  ScanGrid grid;
  Eigen::Vector2d origin;  ///< m, of the frame that all this stands in
  std::vector<Pose2> trajectory = {};
  std::vector<double> times = {};  ///< s, of each scan
  PoseGraph graph = {};            ///< of SLAM
  std::size_t loops = 0;           ///< of SLAM
  std::vector<Pose2> judged = {},
                     reference = {};  ///< poses for which a reference is known, and these
  std::size_t beams = 0;
  std::string warnings = {};  ///< what of the log could not be read, or was missed
  bool interrupted = false;
};

void insert(MappedLog& mapped, LogRecord record, const Pose2& T_map_robot) {
  record.scan.T_map_sensor = T_map_robot * record.T_robot_sensor;
  mapped.map.insert(record.scan);
  mapped.grid.insert(record.scan);
  mapped.beams += record.scan.size();
  mapped.trajectory.push_back(T_map_robot);
  mapped.times.push_back(record.has_time ? record.time : 0.0);
  if (const auto reference = referencePose(record)) {
    mapped.judged.push_back(T_map_robot);
    mapped.reference.push_back(*reference);
  }
}

/// "1 scan(s) far from all others, the first is number 12 at 1e+07, 3.2 m"; empty where there is
/// none.
std::string straysTold(const MappedLog& mapped) {
  const std::vector<bool> stray = findStrays(mapped.trajectory);
  const auto count = std::count(stray.begin(), stray.end(), true);
  if (count == 0) return "";
  const auto first =
      static_cast<std::size_t>(std::find(stray.begin(), stray.end(), true) - stray.begin());
  const Eigen::Vector2d place = mapped.origin + mapped.trajectory[first].position();
  char text[160];
  std::snprintf(text, sizeof text,
                "%td scan(s) far from all others, the first is number %zu at %.9g, %.9g m", count,
                first, place.x(), place.y());
  return text;
}

/// @return  what had to be done without.
std::string locateScanByScan(LocalLog& log, PoseSource poses, MappedLog& mapped,
                             const Interruption& interruption) {
  Progress progress("map");
  while (auto record = log.next()) {
    const Pose2 T_map_robot = poses.locate(*record);
    insert(mapped, std::move(*record), T_map_robot);
    progress.show(log.progress(), std::to_string(mapped.trajectory.size()) + " scans");
    mapped.interrupted = interruption.requested();
    if (mapped.interrupted) break;
  }
  return poses.warnings();
}

/// Line SLAM: the whole log is gone through before the first line is drawn. It begins where the log
/// does, for then its errors can be told.
/// @return  what had to be done without.
std::string locateBySlam(LocalLog& log, MappedLog& mapped, const Interruption& interruption) {
  std::vector<LogRecord> records;
  std::optional<Slam> slam;
  std::size_t without_odometry = 0;
  Progress progress("locate");
  while (auto record = log.next()) {
    if (!slam) slam.emplace(referencePose(*record).value_or(logPose(*record)));
    slam->step(record->scan, record->T_robot_sensor, record->odometry);
    without_odometry += !record->odometry;
    records.push_back(std::move(*record));
    progress.show(log.progress(), std::to_string(records.size()) + " scans, " +
                                      std::to_string(slam->loops().size()) + " loops closed");
    mapped.interrupted = interruption.requested();
    if (mapped.interrupted) break;
  }
  if (!slam) return "";
  if (!mapped.interrupted) slam->finish();
  const std::vector<Pose2> trajectory = slam->trajectory();
  for (std::size_t k = 0; k < records.size(); ++k) {
    insert(mapped, std::move(records[k]), trajectory[k]);
  }
  mapped.graph = slam->keyFrames().graph;
  mapped.loops = slam->loops().size();
  if (without_odometry == 0) return "";
  return std::to_string(without_odometry) + " scan(s) without odometry, located by the laser alone";
}

MappedLog mapLog(const MapOptions& options, LocalLog& log, const Parameters& parameters,
                 const Interruption& interruption) try {
  MappedLog mapped{LineMap(parameters.mapping), ScanGrid(log.start()), log.origin()};
  const PoseKind kind = poseKind(options.pose);
  const std::string of_poses =
      kind == PoseKind::kSlam
          ? locateBySlam(log, mapped, interruption)
          : locateScanByScan(log, PoseSource(kind, parameters.icp), mapped, interruption);
  mapped.map.finishBatch();
  for (const std::string& warning : {log.warnings(), of_poses, straysTold(mapped)}) {
    if (!mapped.warnings.empty() && !warning.empty()) mapped.warnings += "; ";
    mapped.warnings += warning;
  }
  return mapped;
} catch (const std::runtime_error& error) {
  throw std::runtime_error(options.log + ": " + error.what());
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

MapProducts products(const MapOptions& options, const Parameters& parameters,
                     const MappedLog& mapped) {
  MapProducts products;
  products.title = std::filesystem::path(options.log).filename().string();
  products.lines = mapped.map.lines();
  products.poly_lines = mapped.map.polyLines();
  products.trajectory = mapped.trajectory;
  products.times = mapped.times;
  products.graph = mapped.graph;
  products.grid = mapped.grid.grid();
  products.origin = mapped.origin;
  auto& summary = products.summary;
  summary["program"] = "cca-mrpt " CCA_VERSION;
  summary["log"] = options.log;
  summary["finished"] = !mapped.interrupted;
  summary["pose"] = options.pose;
  summary["scans"] = mapped.trajectory.size();
  summary["beams"] = mapped.beams;
  summary["distance_m"] = pathLength(mapped.trajectory);
  if (mapped.graph.size() > 0) {
    summary["key_frames"] = mapped.graph.size();
    summary["loops"] = mapped.loops;
  }
  if (!mapped.warnings.empty()) summary["warnings"] = mapped.warnings;
  std::vector<std::string> used{"mapping"};
  if (options.pose == "icp") used.push_back("icp");
  summary["parameters"] = parametersJson(parameters, used);
  // Poses taken from the log are their own reference, and would be called perfect.
  if (options.pose != "log" && options.pose != "truth" && !mapped.reference.empty()) {
    const TrajectoryError error = compareTrajectories(mapped.judged, mapped.reference);
    summary["pose_error"] = {{"rms_m", error.rms_m},
                             {"max_m", error.max_m},
                             {"rms_deg", error.rms_deg},
                             {"at_end_m", error.at_end_m}};
  }
  return products;
}

void report(const MapOptions& options, const MapProducts& products, double seconds) {
  const auto& summary = products.summary;
  std::printf("%zu lines from %zu scans over %.1f m in %.2f s\n", products.lines.size(),
              summary["scans"].get<std::size_t>(), summary["distance_m"].get<double>(), seconds);
  if (summary.contains("pose_error")) {
    const auto& error = summary["pose_error"];
    std::printf(
        "poses by %s: %.3f m rms from the log's own after the best fit, %.2f m at the end\n",
        options.pose.c_str(), error["rms_m"].get<double>(), error["at_end_m"].get<double>());
  }
  std::printf("%s holds the map: map.png to look at, lines.csv and others to use\n",
              options.out.c_str());
}

void makeMap(MapOptions options, const Parameters& parameters) {
  const auto begin = std::chrono::steady_clock::now();
  const Interruption interruption;
  LocalLog log(openLog(options.log));
  if (interruption.requested()) throw std::runtime_error("interrupted; no map was begun");
  // Where nobody says where poses come from: the log's own where somebody corrected them.
  if (options.pose.empty()) options.pose = log.beginsCorrected() ? "log" : "slam";
  std::error_code unknown;
  const bool is_new = !std::filesystem::exists(options.out, unknown);
  const FolderLock folder = prepareMapFolder(options.out, options.force);
  const MappedLog mapped = [&] {
    try {
      return mapLog(options, log, parameters, interruption);
    } catch (...) {  // a pose that the log lacks: nothing remains
      std::error_code holds_files;
      if (is_new) std::filesystem::remove(options.out, holds_files);
      throw;
    }
  }();
  tellWarnings(options.log, mapped.warnings);
  MapProducts map = products(options, parameters, mapped);
  const std::chrono::duration<double> mapping = std::chrono::steady_clock::now() - begin;
  map.summary["mapping_s"] = mapping.count();
  writeMapFolder(options.out, map);
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
  if (!options.quiet) report(options, map, all.count());
  if (mapped.interrupted) {
    throw std::runtime_error("interrupted after " + std::to_string(mapped.trajectory.size()) +
                             " scans; the map so far is in " + options.out);
  }
}

}  // namespace

void addMapCommand(CLI::App& program) {
  auto* command = program.add_subcommand("map", "line map of a whole log");
  auto options = std::make_shared<MapOptions>();
  command->add_option("LOG", options->log, "MRPT .rawlog or .simplemap, CARMEN .log, ROS .bag")
      ->required();
  command->add_option("--out", options->out, "folder to write the map to")->required();
  command
      ->add_option("--pose", options->pose,
                   "where the poses come from; by default the log's own where it holds corrected "
                   "ones, else line SLAM")
      ->check(CLI::IsMember({"log", "slam", "odometry", "icp", "truth"}));
  command->add_flag("--force", options->force, "overwrite a map that is there");
  command->add_flag("--quiet", options->quiet, "print nothing but errors");
  auto parameters =
      std::make_shared<ParameterOptions>(*command, std::vector<std::string>{"mapping", "icp"});
  command->callback([options, parameters] { makeMap(*options, parameters->resolve()); });
}

}  // namespace cca::apps
