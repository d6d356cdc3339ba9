// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/logs/log_warnings.hpp"
#include "apps/logs/mapped_logs.hpp"
#include "apps/options/log_hint_options.hpp"
#include "apps/options/origin_option.hpp"
#include "apps/options/parameter_options.hpp"
#include "apps/options/serve_options.hpp"
#include "apps/runs/interruption.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "commands.hpp"
#include "io/maps/map_folder.hpp"
#include "io/poses/local_frame.hpp"

namespace cca::apps {
namespace {

struct MapOptions {
  std::vector<std::string> logs;
  std::string out, pose, resume;  // no pose source named: see makeMap()
  std::shared_ptr<const LogHints> hints;
  std::shared_ptr<const ServeOptions> serve;
  std::optional<GeoReference> place;
  bool force = false, quiet = false;
};

/// Where nobody says where poses come from: the log's own where somebody corrected them.
PoseSource chosenPose(const MapOptions& options, const LocalLog& first) {
  const bool is_one = options.logs.size() == 1 && options.resume.empty();
  if (options.pose.empty()) {
    return is_one && first.beginsCorrected() ? PoseSource::kLog : PoseSource::kSlam;
  }
  const PoseSource pose = poseSource(options.pose);
  if (!is_one && pose != PoseSource::kSlam) {
    throw std::runtime_error("--pose " + options.pose +
                             ": several logs, and logs with --resume, are joined by --pose slam");
  }
  return pose;
}

void report(const MapOptions& options, const MapProducts& products, double seconds) {
  const auto& summary = products.summary;
  std::printf("%zu lines from %zu scans over %.1f m in %.2f s\n", products.lines.size(),
              summary["scans"].get<std::size_t>(), summary["distance_m"].get<double>(), seconds);
  if (summary.contains("pose_error")) {
    const auto& error = summary["pose_error"];
    std::printf(
        "poses by %s: %.3f m rms from the log's own after the best fit, %.2f m at the end\n",
        summary["pose"].get<std::string>().c_str(), error["rms_m"].get<double>(),
        error["at_end_m"].get<double>());
  }
  std::printf("%s holds the map: map.png to look at, lines.csv and others to use\n",
              options.out.c_str());
}

std::unique_ptr<LocalLog> open(const MapOptions& options, std::size_t k) {
  return std::make_unique<LocalLog>(openLog(options.logs[k], *options.hints));
}

std::unique_ptr<MappedLogs> mapLogs(const MapOptions& options, std::unique_ptr<LocalLog> first,
                                    const Parameters& parameters, LivePage* page,
                                    const Interruption& interruption) {
  LogsToMap logs;
  logs.paths = options.logs;
  logs.pose = chosenPose(options, *first);
  logs.resumed = options.resume;
  logs.sweep = options.hints->sweep;
  if (!options.resume.empty()) logs.memory = loadMemory(options.resume);
  auto mapped = std::make_unique<MappedLogs>(logs, *first, parameters);
  if (page) mapped->obey(*page);
  for (std::size_t k = 0; k < options.logs.size() && !mapped->isInterrupted(); ++k) {
    auto log = k == 0 ? std::move(first) : open(options, k);
    mapped->take(options.logs[k], *log, interruption);
  }
  mapped->finish();
  return mapped;
}

std::unique_ptr<LivePage> openPage(const MapOptions& options, const LocalLog& first) {
  LivePageSettings settings;
  settings.title = std::filesystem::path(options.logs.front()).filename().string();
  settings.origin = first.origin();
  return serve(*options.serve, settings);
}

/// Where no place of the earlier map was found, its memory may be the one that is in the way.
void keepEarlier(const MapOptions& options, const MapProducts& map) {
  if (options.resume.empty() || map.summary["found_in_memory"].get<bool>()) return;
  const std::string kept = keepMemory(options.out);
  if (kept.empty()) return;
  std::fprintf(stderr, "cca-mrpt: the map.slam that was there is kept: %s\n", kept.c_str());
}

void makeMap(const MapOptions& options, const Parameters& parameters) {
  const auto begin = std::chrono::steady_clock::now();
  const Interruption interruption;
  auto log = open(options, 0);
  if (interruption.requested()) throw std::runtime_error("interrupted; no map was begun");
  const std::unique_ptr<LivePage> page = openPage(options, *log);
  std::error_code unknown;
  const bool is_new = !std::filesystem::exists(options.out, unknown);
  const FolderLock folder = prepareMapFolder(options.out, options.force, {}, options.logs);
  const std::unique_ptr<const MappedLogs> mapped = [&] {
    try {
      return mapLogs(options, std::move(log), parameters, page.get(), interruption);
    } catch (...) {  // a pose that the log lacks: nothing remains
      std::error_code holds_files;
      if (is_new) std::filesystem::remove(options.out, holds_files);
      throw;
    }
  }();
  tellWarnings(options.logs.front(), mapped->warnings());
  if (mapped->isInterrupted()) tellOfSaving();
  MapProducts map = mapped->products();
  map.place = options.place;
  const std::chrono::duration<double> mapping = std::chrono::steady_clock::now() - begin;
  map.summary["mapping_s"] = mapping.count();
  keepEarlier(options, map);
  writeMapFolder(options.out, map);
  if (page) page->finish(map.lines, mapped->isInterrupted() ? "interrupted" : "all is mapped");
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
  if (!options.quiet) report(options, map, all.count());
  if (mapped->isInterrupted()) {
    throw std::runtime_error("interrupted after " + std::to_string(mapped->scans()) +
                             " scans; the map so far is in " + options.out);
  }
  const std::string shortcoming = mapped->shortcoming();
  if (!shortcoming.empty()) {
    throw Shortcoming(options.logs.front() + ": " + shortcoming + "; the map is in " + options.out);
  }
}

}  // namespace

void addMapCommand(CLI::App& program) {
  auto* command = program.add_subcommand("map", "line map of a whole log, or of several");
  auto options = std::make_shared<MapOptions>();
  command
      ->add_option("LOG", options->logs,
                   "MRPT .rawlog or .simplemap, CARMEN .log, CSV of ranges, CoreSLAM .dat, csm "
                   ".json, ROS .bag; of several, each may begin "
                   "anywhere in the same place")
      ->required();
  command->add_option("--out", options->out, "folder to write the map to")->required();
  command
      ->add_option("--pose", options->pose,
                   "where the poses come from; by default the log's own where it holds corrected "
                   "ones, else line SLAM")
      ->check(CLI::IsMember({"log", "slam", "odometry", "icp", "truth"}));
  command->add_option("--resume", options->resume,
                      "DIR of an earlier map: go on with it, from anywhere in it");
  addOriginOption(*command, options->place, "lines.geojson and plan.geojson are");
  command->add_flag("--force", options->force, "overwrite a map that is there");
  command->add_flag("--quiet", options->quiet, "print nothing but errors");
  options->serve = addServeOptions(*command);
  options->hints = addLogHintOptions(*command);
  auto parameters =
      std::make_shared<ParameterOptions>(*command, std::vector<std::string>{"mapping", "icp"});
  command->callback([options, parameters] { makeMap(*options, parameters->resolve()); });
}

}  // namespace cca::apps
