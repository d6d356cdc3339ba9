// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "apps/logs/log_warnings.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "commands.hpp"
#include "evaluation/log_score.hpp"
#include "evaluation/sigma_score.hpp"
#include "evaluation/world_score.hpp"
#include "io/files/atomic_file.hpp"
#include "io/lines/line_formats.hpp"
#include "io/lines/segments_csv.hpp"

namespace cca::apps {
namespace {

nlohmann::ordered_json toJson(const LogScore& score) {
  nlohmann::ordered_json json;
  for (const auto& group : score.groups) {
    for (const auto& [key, value] : group.figures) {
      // Five digits behind the point, as people read and compare them; null where there is none.
      json[group.name][key] =
          std::isfinite(value) ? nlohmann::json(std::round(value * 1e5) / 1e5) : nullptr;
    }
  }
  return json;
}

/// Lines of single scans stand in the frames of their sensors, and are no map.
void refuseExtracted(const std::string& path) {
  std::ifstream file(path);
  std::string header;
  std::getline(file, header);
  if (header.rfind("scan_id,", 0) != 0) return;
  throw std::runtime_error(path + ": holds the lines of single scans ('extract'), not of a map");
}

LogScore evaluateLog(const std::string& log, const std::vector<Segment2>& map) {
  auto reader = openUndistortedLog(log);
  std::vector<Scan> scans;
  while (auto record = reader->next()) scans.push_back(std::move(record->scan));
  tellWarnings(log, reader->warnings());
  return scoreAgainstLog(scans, map);
}

LogScore evaluateWorld(const std::string& world, const std::string& path,
                       const std::vector<Segment2>& map) {
  const std::string truth = truthPath(world);
  if (!std::filesystem::exists(truth)) {
    throw std::runtime_error(world + ": its true segments are not known; " + truth +
                             " (x1,y1,x2,y2) must stand beside it");
  }
  const std::vector<Segment2> walls = loadSegments(truth);
  LogScore score = scoreAgainstWorld(walls, map);
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  score.groups.push_back(scoreSigmas(walls, readLinesCsv(text, path)));
  return score;
}

}  // namespace

void addEvaluateCommand(CLI::App& program) {
  struct Options {
    std::string map, log, world, out;
  };
  auto* command = program.add_subcommand(
      "evaluate", "quality of a line map against the scans it was made from, or the true world");
  auto options = std::make_shared<Options>();
  command->add_option("MAP", options->map, "line map, CSV x1,y1,x2,y2,...")->required();
  auto* against = command->add_option_group("against");
  against->add_option("--log", options->log, "the laser log that the map was made from");
  against->add_option("--world", options->world, "the world; NAME.truth.csv stands beside it");
  against->require_option(1);
  command->add_option("--out", options->out, "JSON file to write; default: standard output");
  command->callback([options] {
    refuseExtracted(options->map);
    const auto map = loadSegments(options->map);
    const LogScore score = options->log.empty() ? evaluateWorld(options->world, options->map, map)
                                                : evaluateLog(options->log, map);
    const std::string text = toJson(score).dump(1) + "\n";
    if (options->out.empty()) {
      std::fputs(text.c_str(), stdout);
    } else {
      writeFile(options->out, text);
    }
  });
}

}  // namespace cca::apps
