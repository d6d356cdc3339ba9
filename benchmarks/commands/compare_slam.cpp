// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/runs/interruption.hpp"
#include "cca_mrpt/io/scan_raster.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "commands/commands.hpp"
#include "io/files/atomic_file.hpp"
#include "io/maps/map_picture.hpp"
#include "io/poses/local_frame.hpp"
#include "io/poses/pose_files.hpp"
#include "io/poses/pose_source.hpp"
#include "io/poses/trajectory_error.hpp"
#include "peers/particle_slam.hpp"
#include "peers/scan_matchers.hpp"

namespace cca::bench {
namespace {

using namespace apps;

struct SlamComparison {
  std::vector<std::string> logs, methods;
  std::string out;
};

using Log = std::vector<LogRecord>;
/// T_map_robot of each scan.
using Locate = std::function<std::vector<Pose2>(const Log&)>;

struct Method {
  std::string name, source;
  Locate locate;
};

Pose2 startOf(const Log& log) { return referencePose(log.front()).value_or(logPose(log.front())); }

Locate scanByScan(PoseSource source) {
  return [source](const Log& log) {
    const std::unique_ptr<Localiser> localiser = makeLocaliser(source);
    std::vector<Pose2> trajectory;
    for (const LogRecord& record : log) {
      const Measurement measurement = measurementOf(record, source);
      trajectory.push_back(
          localiser->update(measurement, {measurement.scan, {}, {}}, {}).T_map_robot);
    }
    return trajectory;
  };
}

Locate byGraph(cca::ScanMatcher match) {
  return [match](const Log& log) {
    Slam slam(startOf(log), match);
    for (const LogRecord& record : log) {
      slam.step(record.scan, record.T_robot_sensor, record.odometry);
    }
    slam.finish();
    return slam.trajectory();
  };
}

std::vector<Pose2> byParticles(const Log& log) {
  peers::ParticleSlam slam(startOf(log));
  for (const LogRecord& record : log) {
    slam.step(record.scan, record.T_robot_sensor, record.odometry);
  }
  return slam.trajectory();
}

std::vector<Method> allMethods() {
  std::vector<Method> methods{
      {"odometry", "the wheels alone", scanByScan(PoseSource::kOdometry)},
      {"icp-slam", "MRPT's CMetricMapBuilderICP", scanByScan(PoseSource::kIcp)},
      {"rbpf-slam", "MRPT's CMetricMapBuilderRBPF, 10 particles", byParticles}};
  for (const peers::ScanMatcher& matcher : peers::scanMatchers()) {
    methods.push_back({matcher.name, matcher.source, byGraph(matcher.match)});
  }
  return methods;
}

Log readLog(const std::string& path) {
  LocalLog reader(openUndistortedLog(path));
  Log log;
  while (auto record = reader.next()) log.push_back(std::move(*record));
  if (log.empty()) throw std::runtime_error(path + ": holds no scan");
  return log;
}

std::string row(const std::string& name, const Log& log, const std::vector<Pose2>& trajectory,
                double seconds) {
  std::vector<Pose2> judged, reference;
  for (std::size_t k = 0; k < log.size(); ++k) {
    const auto pose = referencePose(log[k]);
    if (!pose) continue;
    judged.push_back(trajectory[k]);
    reference.push_back(*pose);
  }
  const TrajectoryError error = compareTrajectories(judged, reference);
  constexpr double kNoWork = 1e-3;  // s
  const auto rate = static_cast<int>(static_cast<double>(log.size()) / std::max(seconds, kNoWork));
  char text[160];
  std::snprintf(text, sizeof text, "| %s | %.3f | %.2f | %.3f | %s |\n", name.c_str(), error.rms_m,
                error.rms_deg, loopError(judged, reference),
                seconds < kNoWork ? "-" : std::to_string(rate).c_str());
  return text;
}

/// The map that these poses make.
void draw(const std::string& path, const std::string& title, const Log& log,
          const std::vector<Pose2>& trajectory) {
  MapProducts products;
  products.title = title;
  products.trajectory = trajectory;
  LineMap map;
  ScanRaster grid(trajectory.front().position());
  for (std::size_t k = 0; k < log.size(); ++k) {
    Scan scan = log[k].scan;
    scan.T_map_sensor = trajectory[k] * log[k].T_robot_sensor;
    map.insert(scan);
    grid.insert(scan);
  }
  products.lines = map.lines();
  products.poly_lines = map.polyLines();
  products.grid = grid.raster();
  writePicture(path, products);
}

void compareSlam(const SlamComparison& options) {
  const Interruption interruption;
  if (!options.out.empty()) makeFolder(options.out);
  std::string report;
  const auto tell = [&](const std::string& text) {
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
    report += text;
  };
  for (const std::string& path : options.logs) {
    const Log log = readLog(path);
    const std::string title = std::filesystem::path(path).stem().string();
    tell("\n" + title + ", " + std::to_string(log.size()) + " scans\n\n" +
         "| method | m rms | deg rms | loops, m | scans/s |\n|---|---|---|---|---|\n");
    for (const Method& method : allMethods()) {
      if (!options.methods.empty() && std::find(options.methods.begin(), options.methods.end(),
                                                method.name) == options.methods.end()) {
        continue;
      }
      if (interruption.requested()) throw std::runtime_error("interrupted; the table is not whole");
      const auto begin = std::chrono::steady_clock::now();
      const std::vector<Pose2> trajectory = method.locate(log);
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
      tell(row(method.name, log, trajectory, time.count()));
      if (options.out.empty()) continue;
      const std::string stem = options.out + "/" + title + "-" + method.name;
      std::vector<StampedPose> poses;
      for (std::size_t k = 0; k < log.size(); ++k) {
        poses.push_back({log[k].has_time ? log[k].time : 0.0, trajectory[k]});
      }
      writeFile(stem + ".csv", posesCsv(poses));
      draw(stem + ".png", title + ", " + method.source, log, trajectory);
    }
  }
  if (!options.out.empty()) writeFile(options.out + "/slam.md", report);
}

}  // namespace

void addCompareSlamCommand(CLI::App& program) {
  auto* command = program.add_subcommand(
      "compare-slam", "line SLAM beside the odometry, MRPT's SLAMs and published scan matchers");
  auto options = std::make_shared<SlamComparison>();
  command->add_option("LOG", options->logs, "logs whose poses somebody has corrected, or true ones")
      ->required();
  std::vector<std::string> names;
  for (const Method& method : allMethods()) names.push_back(method.name);
  command->add_option("--methods", options->methods, "of them; by default all")
      ->check(CLI::IsMember(names));
  command->add_option("--out", options->out,
                      "folder for poses and a picture each, and the table as slam.md");
  command->callback([options] { compareSlam(*options); });
}

}  // namespace cca::bench
