// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/options/parameter_options.hpp"
#include "cca_mrpt/simulation/laser_models.hpp"
#include "commands/commands.hpp"
#include "evidence/comparison.hpp"
#include "io/files/atomic_file.hpp"

namespace cca::bench {
namespace {

using namespace apps;
using namespace evidence;

struct ExtractorComparison {
  std::vector<std::string> inputs;
  std::vector<double> noises;
  std::vector<std::string> extractors;
  int polygons = 0, scans = 100, fit = 0;
  std::uint64_t seed = 1;
  std::string out;
  bool pieces = false;
};

bool isChosen(const ExtractorComparison& options, const std::string& name) {
  return options.extractors.empty() ||
         std::find(options.extractors.begin(), options.extractors.end(), name) !=
             options.extractors.end();
}

std::vector<std::string> allNames() {
  std::vector<std::string> names{"cca"};
  for (const baselines::Baseline& baseline : baselines::all()) names.push_back(baseline.name);
  return names;
}

bool isWorld(const std::string& path) { return std::filesystem::path(path).extension() == ".yaml"; }

void append(std::vector<LabelledScan>& all, std::vector<LabelledScan> more) {
  for (LabelledScan& scan : more) all.push_back(std::move(scan));
}

std::vector<ScanGroup> gather(const ExtractorComparison& options, const LaserParameters& laser) {
  std::vector<ScanGroup> groups;
  std::vector<double> noises = options.noises;
  if (noises.empty()) noises.push_back(laser.range_noise);
  for (const double noise : noises) {
    ScanGroup group{"simulated", noise, {}};
    Sampling sampling;
    sampling.scans = options.scans;
    sampling.laser = laser;
    sampling.laser.range_noise = noise;
    sampling.seed = options.seed;
    sampling.hidden_walls = options.pieces ? HiddenWalls::kPieces : HiddenWalls::kWhole;
    for (const std::string& input : options.inputs) {
      if (isWorld(input)) append(group.scans, sampleWorld(input, sampling));
    }
    sampling.scans = options.polygons;
    append(group.scans, samplePolygons(sampling));
    if (!group.scans.empty()) groups.push_back(std::move(group));
  }
  ScanGroup real{"real", 0.0, {}};
  for (const std::string& input : options.inputs) {
    if (!isWorld(input)) append(real.scans, sampleLog(input, options.scans));
  }
  if (!real.scans.empty()) groups.push_back(std::move(real));
  if (groups.empty()) throw CLI::RequiredError("INPUT or --polygons");
  return groups;
}

std::string number(double value, int decimals) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string title(const ScanGroup& group) {
  const std::string count = std::to_string(group.scans.size()) + " scans";
  if (group.name == "real") return "Real logs (" + count + ")";
  return "Simulated, range noise " + number(1e3 * group.range_noise, 0) + " mm (" + count + ")";
}

/// One row of a Markdown table: mean and half the width of its 95 % interval.
std::string tableRow(const Contender& c,
                     const std::vector<std::optional<BootstrapEstimate>>& estimates) {
  std::string row = "| " + c.name + " | " + c.parameters + " |";
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& figure = figures()[k];
    if (!estimates[k]) {
      row += " - |";
      continue;
    }
    const double half = 0.5 * (estimates[k]->high - estimates[k]->low);
    row += " " + number(figure.scale * estimates[k]->value, figure.decimals) + " ± " +
           number(figure.scale * half, figure.decimals) + " |";
  }
  return row;
}

std::string tableHead() {
  std::string head = "| extractor | parameters |", rule = "|---|---|";
  for (const Figure& figure : figures()) {
    head += " " + figure.heading + " |";
    rule += "---|";
  }
  return head + "\n" + rule;
}

/// Appends what a contender gave to comparison.csv.
class Results {
 public:
  Results() {
    csv_ << "group,range_noise,extractor,parameters,figure,value,low,high,scans\n";
    csv_.precision(9);
  }
  void add(const ScanGroup& group, const Contender& contender, const std::string& figure,
           const std::optional<BootstrapEstimate>& e) {
    if (!e) return;
    csv_ << group.name << ',' << group.range_noise << ',' << contender.name << ','
         << contender.parameters << ',' << figure << ',' << e->value << ',' << e->low << ','
         << e->high << ',' << group.scans.size() << '\n';
  }
  std::string text() const { return csv_.str(); }

 private:
  std::ostringstream csv_;
};

void compare(const ExtractorComparison& options, const Parameters& parameters) {
  Results results;
  const auto groups = gather(options, parameters.laser);
  if (!options.out.empty()) makeFolder(options.out);
  for (const ScanGroup& group : groups) {
    std::printf("\n### %s\n\n%s\n", title(group).c_str(), tableHead().c_str());
    std::vector<Trial> ours;
    for (const Contender& contender : contenders(parameters.mapping)) {
      if (!isChosen(options, contender.name)) continue;
      const std::vector<Trial> trials = run(contender, group.scans);
      std::vector<std::optional<BootstrapEstimate>> estimates;
      for (const Figure& figure : figures()) {
        estimates.push_back(summarise(trials, figure));
        results.add(group, contender, figure.name, estimates.back());
      }
      std::printf("%s\n", tableRow(contender, estimates).c_str());
      std::fflush(stdout);
      if (contender.name == "cca") {
        ours = trials;
      } else if (!ours.empty()) {
        results.add(group, contender, "f1_minus_cca", f1Difference(trials, ours));
        results.add(group, contender, "lateral_minus_cca", lateralDifference(trials, ours));
      }
    }
  }
  if (options.out.empty()) return;
  writeFile(options.out + "/comparison.csv", results.text());
}

void fit(const ExtractorComparison& options, const Parameters& parameters) {
  std::vector<LabelledScan> scans;
  for (ScanGroup& group : gather(options, parameters.laser)) {
    if (group.name == "simulated") append(scans, std::move(group.scans));
  }
  if (scans.empty())
    throw std::runtime_error("--fit needs worlds or --polygons: logs have no truth");
  for (const baselines::Baseline& baseline : baselines::all()) {
    if (!isChosen(options, baseline.name)) continue;
    const Fit best = fitParameters(baseline, scans, options.fit, options.seed);
    std::printf("%s: F1 %.4f with %s\n", baseline.name.c_str(), best.f1, best.parameters.c_str());
    std::fflush(stdout);
  }
}

}  // namespace

void addCompareExtractorsCommand(CLI::App& program) {
  auto* command = program.add_subcommand("compare-extractors",
                                         "classical line extractors and ours on the same scans");
  auto options = std::make_shared<ExtractorComparison>();
  command->add_option("INPUT", options->inputs,
                      "worlds (.yaml, true segments beside them) and logs");
  command->add_option("--polygons", options->polygons, "also scans from inside random polygons")
      ->check(CLI::Range(0, 100000));
  command->add_option("--scans", options->scans, "scans of each input")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command
      ->add_option("--noise", options->noises,
                   "range noises of the simulated scans [m], separated by commas")
      ->delimiter(',')
      ->check(valueOf("laser.range_noise"));
  command->add_option("--extractors", options->extractors, "only these, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(allNames()));
  command->add_option("--seed", options->seed, "of places, noise and draws")
      ->check(valueOf("run.seed"))
      ->capture_default_str();
  command
      ->add_option("--fit", options->fit,
                   "draw so many parameter sets for each baseline and print the best")
      ->check(CLI::Range(0, 100000));
  command->add_flag(
      "--pieces", options->pieces,
      "a wall that something partly hides counts as several, one for each visible piece");
  command->add_option("--out", options->out, "folder for comparison.csv");
  Parameters defaults;
  defaults.laser = laserModel("ideal").laser;  // single scans have no motion to undo
  auto parameters = std::make_shared<ParameterOptions>(
      *command, std::vector<std::string>{"mapping", "laser"}, defaults);
  command->callback([options, parameters] {
    const Parameters resolved = parameters->resolve();
    options->fit > 0 ? fit(*options, resolved) : compare(*options, resolved);
  });
}

}  // namespace cca::bench
