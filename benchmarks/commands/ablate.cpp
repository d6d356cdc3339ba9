// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "apps/runs/progress.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/session/mapping_session.hpp"
#include "commands/commands.hpp"
#include "evaluation/log_score.hpp"
#include "evidence/statistics.hpp"
#include "evidence/tuning_design.hpp"
#include "simulation/random.hpp"

namespace cca::bench {
namespace {

using namespace apps;
using namespace evidence;

struct LeftOut {
  Part part;
  const char* meaning;
};

constexpr LeftOut kParts[] = {
    {Part::kOrientation, "mu_1, orientation"},
    {Part::kOffset, "mu_2, offset"},
    {Part::kGap, "mu_3, gap"},
    {Part::kFit, "mu_4, fit"},
    {Part::kOverlap, "mu_5, overlap"},
    {Part::kRankOrder, "King's sorts"},
    {Part::kCompleteLinkage, "linkage: one is enough"},
    {Part::kKMeans, "K-means: boundaries stay"},
    {Part::kPruning, "cluster pruning"},
    {Part::kRounds, "rounds: one in a scan"},
    {Part::kInterrupted, "walls behind things"},
    {Part::kCorners, "corners: K-means once"},
    {Part::kScanNoise, "noise from the scan: 3 cm"},
    {Part::kPoseNoise, "pose error: 3 cm, 0.01 rad"},
    {Part::kWallsToWalls, "walls against walls"},
    {Part::kYielding, "yielding, side by side"},
    {Part::kBends, "cuts at bends"},
    {Part::kRays, "rays that went through"},
    {Part::kHindsight, "evidence assigned anew at the end"},
};

struct AblationOptions {
  std::vector<std::string> logs;
  TuningDesign design;
  int shakes = 2;
  std::vector<std::string> only;

  /// The parts whose meaning holds one of `only`; all where that is empty.
  std::vector<LeftOut> parts() const {
    std::vector<LeftOut> asked;
    for (const LeftOut& part : kParts) {
      const bool named = std::any_of(only.begin(), only.end(), [&](const std::string& word) {
        return std::string_view(part.meaning).find(word) != std::string_view::npos;
      });
      if (named || only.empty()) asked.push_back(part);
    }
    return asked;
  }
};

/// What the whole algorithm reaches in each case, and by how much it falls without each part.
struct LossFigure {
  LossFigure(const char* title, std::size_t parts) : name(title), losses(parts) {}
  const char* name;
  std::vector<double> whole;
  std::vector<std::vector<double>> losses;
};

struct Study {
  std::vector<LeftOut> parts;
  LossFigure scans{"scans, F1", parts.size()}, worlds{"maps of worlds, F1", parts.size()},
      logs{"maps of logs, F", parts.size()};
};

CcaParameters without(Part part) {
  CcaParameters parameters;
  parameters.without = Ablation(part);
  return parameters;
}

void studyWorlds(const AblationOptions& options, Progress& progress, Study& study) {
  const TuningDesign& design = options.design;
  for (std::size_t k = 0; !design.worlds.empty() && k < design.jobs(); ++k) {
    TuningJob job = tuningJob(design, k);
    const Scene scene = makeScene(design, job);
    const TuningRow whole = runJob(job, scene);
    study.scans.whole.push_back(whole.scan_f1);
    study.worlds.whole.push_back(whole.map_f1);
    for (std::size_t p = 0; p < study.parts.size(); ++p) {
      job.parameters.without = Ablation(study.parts[p].part);
      const TuningRow row = runJob(job, scene);
      study.scans.losses[p].push_back(whole.scan_f1 - row.scan_f1);
      study.worlds.losses[p].push_back(whole.map_f1 - row.map_f1);
    }
    progress.show(static_cast<double>(k) / static_cast<double>(design.jobs()), job.world);
  }
}

/// End points that a map is scored on: the score is most of the time.
constexpr int kMostPoints = 60000;

double scoreOfMap(const std::vector<Scan>& scans, const CcaParameters& parameters) {
  MappingSession session(std::make_unique<GivenPoses>(), {parameters, false, 0.0});
  for (const Scan& scan : scans) {
    Measurement measurement;
    measurement.scan = scan;
    measurement.T_map_robot = scan.T_map_sensor;
    session.add(measurement);
  }
  session.finish();
  std::vector<Segment2> segments;
  for (const MapLine& line : session.lineMap().lines()) {
    segments.push_back({line.segment.start, line.segment.end});
  }
  LogScoreParameters fewer;
  fewer.max_points = kMostPoints;
  return scoreAgainstLog(scans, segments, fewer).at("summary").at("f_score");
}

/// Poses shaken by 0.2 mm and 0.001 degrees found walls in another order: a run of its own.
void shake(std::vector<Scan>& scans, int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  for (Scan& scan : scans) {
    scan.T_map_sensor.x += 2e-4 * random.normal();
    scan.T_map_sensor.y += 2e-4 * random.normal();
    scan.T_map_sensor.theta += 0.001 * M_PI / 180.0 * random.normal();
  }
}

void studyLogs(const AblationOptions& options, Progress& progress, Study& study) {
  double done = 0.0;
  for (const std::string& path : options.logs) {
    const auto reader = openUndistortedLog(path);
    std::vector<Scan> scans;
    while (auto record = reader->next()) scans.push_back(std::move(record->scan));
    if (!reader->warnings().empty()) {
      std::fprintf(stderr, "cca-mrpt-bench: %s: %s\n", path.c_str(), reader->warnings().c_str());
    }
    for (int seed = 1; seed <= options.shakes; ++seed) {
      std::vector<Scan> shaken = scans;
      shake(shaken, seed);
      const double whole = scoreOfMap(shaken, {});
      study.logs.whole.push_back(whole);
      for (std::size_t p = 0; p < study.parts.size(); ++p) {
        study.logs.losses[p].push_back(whole - scoreOfMap(shaken, without(study.parts[p].part)));
      }
      const double all = static_cast<double>(options.logs.size()) * options.shakes;
      progress.show(++done / all, std::filesystem::path(path).filename().string());
    }
  }
}

void printCell(const std::vector<double>& values) {
  if (values.empty()) {
    std::printf(" - |");
    return;
  }
  const BootstrapEstimate e = bootstrapMean(values);
  const bool lost = e.low > 0.0, gained = e.high < 0.0;
  const char* mark = lost || gained ? "**" : "";
  std::printf(" %s%.4f%s [%.4f, %.4f] |", mark, e.value, mark, e.low, e.high);
}

void print(const Study& study) {
  const LossFigure* figures[] = {&study.scans, &study.worlds, &study.logs};
  std::printf("| left out |");
  for (const LossFigure* f : figures) std::printf(" %s (%zu) |", f->name, f->whole.size());
  std::printf("\n|---|---|---|---|\n| nothing: what is reached |");
  for (const LossFigure* f : figures) printCell(f->whole);
  for (std::size_t p = 0; p < study.parts.size(); ++p) {
    std::printf("\n| %s |", study.parts[p].meaning);
    for (const LossFigure* f : figures) printCell(f->losses[p]);
  }
  std::printf("\n");
}

void ablate(const AblationOptions& options) {
  if (options.design.worlds.empty() && options.logs.empty()) {
    throw CLI::ValidationError("WORLD", "name at least one world or --log");
  }
  Study study{options.parts()};
  if (study.parts.empty()) throw CLI::ValidationError("--only", "names no part");
  Progress progress("ablate");
  studyWorlds(options, progress, study);
  studyLogs(options, progress, study);
  print(study);
}

}  // namespace

void addAblateCommand(CLI::App& program) {
  auto* command = program.add_subcommand(
      "ablate", "what each part of the algorithm is worth: left out, one at a time");
  auto options = std::make_shared<AblationOptions>();
  TuningDesign& design = options->design;
  const CcaParameters shipped;
  design.similarity_cut = {shipped.similarity_cut};
  design.vertex_price = {shipped.vertex_price};
  design.straightness = {shipped.straightness};
  design.noises = {0.01, 0.03, 0.1};
  command->add_option("WORLD", design.worlds, "worlds (.yaml, true segments beside them)");
  command->add_option("--log", options->logs, "logs with corrected poses");
  command->add_option("--only", options->only, "parts whose names hold one of these words");
  const auto count = [command](const char* name, int& value, const char* meaning) {
    command->add_option(name, value, meaning)->check(CLI::Range(1, 1000000))->capture_default_str();
  };
  count("--seeds", design.seeds, "repetitions of each world and range noise (1, 3, 10 cm)");
  count("--scans", design.scans, "single scans of each scene");
  count("--poses", design.poses, "longest tour for a map, in scans");
  count("--shakes", options->shakes, "runs of each log, poses shaken by 0.2 mm");
  command->callback([options] { ablate(*options); });
}

}  // namespace cca::bench
