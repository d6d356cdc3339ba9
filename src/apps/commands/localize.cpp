// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/logs/localized_log.hpp"
#include "apps/logs/log_warnings.hpp"
#include "apps/options/log_hint_options.hpp"
#include "apps/runs/interruption.hpp"
#include "apps/runs/progress.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "commands.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/stray_places.hpp"
#include "io/lines/line_formats.hpp"
#include "io/logs/measurements.hpp"
#include "io/maps/map_folder.hpp"
#include "io/maps/map_picture.hpp"
#include "io/plans/plan_reader.hpp"

namespace cca::apps {
namespace {

constexpr const char *kPictureName = "localisation.png", *kCovariancesName = "covariances.csv";

struct LocalizeOptions {
  std::string log, plan, out;
  std::vector<double> start;  ///< x, y in m, heading in degrees; empty: anywhere
  double scale = 0.0;
  std::shared_ptr<const LogHints> hints;
  bool force = false, quiet = false;
};

nlohmann::ordered_json summaryOf(const LocalizeOptions& options, const PlanFile& plan,
                                 const LocalizedLog& log) {
  nlohmann::ordered_json summary;
  summary["program"] = "cca-mrpt " CCA_VERSION;
  summary["log"] = options.log;
  log.describe(plan, options.plan, summary);
  return summary;
}

void write(const LocalizeOptions& options, const PlanFile& plan, const LocalizedLog& log) {
  const std::filesystem::path folder(options.out);
  MapProducts products;
  products.title = std::filesystem::path(options.log).filename().string();
  products.lines = mapLinesOf(plan.lines);
  for (const StampedPose& pose : log.poses()) products.trajectory.push_back(pose.T_map_robot);
  writeFile((folder / "poses.csv").string(), posesCsv(log.poses()));
  writeFile((folder / "poses.tum").string(), posesTum(log.poses()));
  writeFile((folder / kCovariancesName).string(), log.covariancesCsv());
  writePicture((folder / kPictureName).string(), products);
  writeFile((folder / "summary.json").string(), summaryOf(options, plan, log).dump(2) + "\n");
}

void report(const LocalizeOptions& options, const PlanFile& plan, const LocalizedLog& log) {
  std::printf("%s: %s (%s); %zu of %zu scans localised, lost %d time(s)\n", options.plan.c_str(),
              sizeInWords(plan.lines).c_str(), plan.kind.c_str(), log.poses().size(), log.scans(),
              log.timesLost());
  if (!plan.not_understood.empty()) {
    std::printf("the plan also holds %s, which is no line\n", plan.not_understood.c_str());
  }
  if (log.explainedShare() > 0.0) {
    std::printf("%.0f %% of the returns are explained by the plan, to %.3f m rms\n",
                100.0 * log.explainedShare(), log.residual());
  }
  std::printf("%s holds the poses: poses.csv, and %s to look at\n", options.out.c_str(),
              kPictureName);
}

void localize(const LocalizeOptions& options) {
  const Interruption interruption;
  const PlanFile plan = readPlan(options.plan, options.scale);
  const std::unique_ptr<LogReader> reader = openUndistortedLog(options.log, *options.hints);
  std::optional<Pose2> start;
  if (!options.start.empty()) {
    start = {options.start[0], options.start[1], wrapAngle(options.start[2] * M_PI / 180.0)};
  }
  std::error_code unknown;
  if (std::filesystem::exists(std::filesystem::path(options.out) / "lines.csv", unknown)) {
    throw std::runtime_error(options.out +
                             ": holds a map; its poses.csv and summary.json would be lost, --out "
                             "needs a folder without one");
  }
  const bool is_new = !std::filesystem::exists(options.out, unknown);
  const FolderLock folder =
      prepareMapFolder(options.out, options.force, {}, {options.log, options.plan});
  LocalizedLog log(plan.lines, plan.sigmas, start);
  try {
    Progress progress("localise");
    log.take(*reader, [&] {
      progress.show(reader->progress(), std::to_string(log.scans()) + " scans, " +
                                            std::to_string(log.poses().size()) + " localised");
      return !interruption.requested();
    });
  } catch (const std::exception& error) {
    if (is_new) std::filesystem::remove(options.out, unknown);
    throw std::runtime_error(options.log + ": " + error.what());
  }
  tellWarnings(options.log, log.warnings());
  withdrawSummary(options.out);
  write(options, plan, log);
  if (!options.quiet) report(options, plan, log);
  if (log.isInterrupted()) {
    throw std::runtime_error("interrupted after " + std::to_string(log.scans()) +
                             " scans; the poses so far are in " + options.out);
  }
  const std::string shortcoming = log.shortcoming(plan, options.plan);
  if (!shortcoming.empty()) throw Shortcoming(options.log + ": " + shortcoming);
}

}  // namespace

void addLocalizeCommand(CLI::App& program) {
  auto* command = program.add_subcommand(
      "localize", "poses of a log in a finished map or a drawn plan, which stays as it is");
  auto options = std::make_shared<LocalizeOptions>();
  command
      ->add_option("LOG", options->log,
                   "MRPT .rawlog, CARMEN .log, CSV of ranges, CoreSLAM .dat, csm .json, ROS .bag; "
                   "it may begin anywhere")
      ->required();
  command
      ->add_option("--in", options->plan,
                   "folder of a map, its lines.csv or map.slam, or a plan: .geojson, .dxf, .svg, "
                   "or the .yaml of a map_server grid")
      ->required()
      ->type_name("PLAN");
  command->add_option("--out", options->out, "folder to write the poses to")->required();
  command
      ->add_option("--start", options->start,
                   "X,Y,DEG where the log begins, to half a metre and 15 degrees; by default it is "
                   "looked for in the whole plan")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::Range(-kFarthestPlan, kFarthestPlan));
  command
      ->add_option("--scale", options->scale,
                   "metres of a unit of the drawing or .csv, instead of those that it tells")
      ->check(CLI::Range(1e-6, 1e6));
  command->add_flag("--force", options->force, "overwrite what is there");
  command->add_flag("--quiet", options->quiet, "print nothing but errors");
  options->hints = addLogHintOptions(*command);
  command->callback([options] { localize(*options); });
}

}  // namespace cca::apps
