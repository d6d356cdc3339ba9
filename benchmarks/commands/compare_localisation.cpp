// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/logs/pose_errors.hpp"
#include "apps/logs/told_start.hpp"
#include "apps/runs/interruption.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/known_map/known_map.hpp"
#include "cca_mrpt/mapping/line_extraction.hpp"
#include "commands/commands.hpp"
#include "io/logs/measurements.hpp"
#include "io/plans/plan_reader.hpp"
#include "peers/monte_carlo.hpp"

namespace cca::bench {
namespace {

using namespace apps;
using peers::MonteCarlo;
using peers::MonteCarloSettings;

struct LocalisationComparison {
  std::vector<std::string> logs;
  std::string plan;
};

using Log = std::vector<LogRecord>;

struct Tracker {
  std::string name;
  std::function<std::unique_ptr<Localiser>(const PlanFile&, const Pose2& start)> begin;
};

Tracker monteCarlo(const std::string& name, const MonteCarloSettings& settings) {
  return {name, [settings](const PlanFile& plan, const Pose2& start) {
            return std::make_unique<MonteCarlo>(plan.lines, start, settings);
          }};
}

std::vector<Tracker> allTrackers() {
  const auto byLines = [](const PlanFile& plan, const Pose2& start) {
    auto lines = std::make_unique<KnownMap>(plan.lines, plan.sigmas);
    placeAbout(start, *lines);
    return lines;
  };
  // amcl's own settings, and finer ones that cost more.
  return {{"lines", byLines},
          monteCarlo("mrpt-mcl", {100, 5000, 30, 0.2}),
          monteCarlo("mrpt-mcl, 500, 60 beams", {500, 5000, 60, 0.1}),
          monteCarlo("mrpt-mcl, 2000, 180 beams", {2000, 2000, 180, 0.05})};
}

Log readJudgedLog(const std::string& path) {
  const std::unique_ptr<LogReader> reader = openUndistortedLog(path);
  Log log;
  while (auto record = reader->next()) log.push_back(std::move(*record));
  if (log.empty() || !referencePose(log.front())) {
    throw std::runtime_error(path + ": holds no true or corrected poses to compare with");
  }
  return log;
}

/// The first scans are to find the place: what is told is half a metre off.
constexpr std::size_t kToSettle = 20;

std::string row(const Tracker& tracker, const Log& log, const PlanFile& plan) {
  const std::unique_ptr<Localiser> localiser = tracker.begin(plan, *referencePose(log.front()));
  PoseErrors errors;
  std::size_t unknown = 0;
  std::chrono::duration<double> spent{0.0};
  for (std::size_t k = 0; k < log.size(); ++k) {
    const Measurement measurement = measurementOf(log[k], PoseSource::kSlam);
    const auto begin = std::chrono::steady_clock::now();
    const Estimate estimate = localiser->update(measurement, analyse(measurement.scan), {});
    spent += std::chrono::steady_clock::now() - begin;
    if (k < kToSettle) continue;
    const auto reference = referencePose(log[k]);
    if (!estimate.is_known) ++unknown;
    if (estimate.is_known && reference) errors.add(estimate, *reference);
  }
  char text[200];
  std::snprintf(text, sizeof text, "| %s | %.3f | %.3f | %.2f | %zu | %.2f | %.1f | %.2f |\n",
                tracker.name.c_str(), errors.rms(), errors.worst(), errors.rmsTurn() * 180.0 / M_PI,
                unknown, errors.nees(), 100.0 * errors.within(),
                1e3 * spent.count() / static_cast<double>(log.size()));
  return text;
}

void compareLocalisation(const LocalisationComparison& options) {
  const Interruption interruption;
  const PlanFile plan = readPlan(options.plan);
  for (const std::string& path : options.logs) {
    const Log log = readJudgedLog(path);
    std::printf(
        "\n%s in %s, %zu scans\n\n| method | rms m | worst m | rms deg | unknown | NEES | "
        "%% in 99 %% | ms a scan |\n|---|---|---|---|---|---|---|---|\n",
        path.c_str(), options.plan.c_str(), log.size());
    for (const Tracker& tracker : allTrackers()) {
      if (interruption.requested()) throw std::runtime_error("interrupted; the table is not whole");
      std::fputs(row(tracker, log, plan).c_str(), stdout);
      std::fflush(stdout);
    }
  }
}

}  // namespace

void addCompareLocalisationCommand(CLI::App& program) {
  auto* command = program.add_subcommand("compare-localisation",
                                         "localisation in a plan beside MRPT's particle filter");
  auto options = std::make_shared<LocalisationComparison>();
  command
      ->add_option("LOG", options->logs, "logs that hold true poses, or such that were corrected")
      ->required();
  command->add_option("--in", options->plan, "map or plan, as localize takes it")
      ->required()
      ->type_name("PLAN");
  command->callback([options] { compareLocalisation(*options); });
}

}  // namespace cca::bench
