// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "cca_mrpt/evaluation/log_score.hpp"
#include "cca_mrpt/evaluation/world_score.hpp"
#include "cca_mrpt/io/atomic_file.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "commands.hpp"
#include "log_warnings.hpp"

namespace cca::apps {
namespace {

constexpr double kFarthest = 1e5;  // m; what is scored is sampled every few centimetres

/// Rows x1,y1,x2,y2[,...] by comma or blank; a first row that is no numbers is the header, lines
/// that begin with # are comments.
std::vector<Segment2> readSegments(const std::string& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error(path + ": cannot be read");
  }
  std::vector<Segment2> segments;
  std::string line;
  bool first = true;
  for (int number = 1; std::getline(file, line); ++number) {
    for (char& c : line) c = c == ',' || c == ';' || c == '\r' ? ' ' : c;
    if (line.find_first_not_of(' ') == std::string::npos || line[0] == '#') continue;
    std::istringstream row(line);
    Segment2 s;
    row >> s.start.x() >> s.start.y() >> s.end.x() >> s.end.y();
    const bool numbers = static_cast<bool>(row), is_header = first && !numbers;
    first = false;
    if (is_header) continue;
    const double farthest =
        std::max(s.start.lpNorm<Eigen::Infinity>(), s.end.lpNorm<Eigen::Infinity>());
    if (!numbers || !(farthest <= kFarthest)) {
      throw std::runtime_error(path + ":" + std::to_string(number) +
                               ": needs four numbers x1,y1,x2,y2 in [-1e5, 1e5] m");
    }
    segments.push_back(s);
  }
  return segments;
}

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

LogScore evaluateLog(const std::string& log, const std::vector<Segment2>& map) {
  auto reader = openLog(log);
  std::vector<Scan> scans;
  while (auto record = reader->next()) scans.push_back(std::move(record->scan));
  tellWarnings(log, *reader);
  return scoreAgainstLog(scans, map);
}

LogScore evaluateWorld(const std::string& world, const std::vector<Segment2>& map) {
  const std::string truth = std::filesystem::path(world).replace_extension(".truth.csv");
  if (!std::filesystem::exists(truth)) {
    throw std::runtime_error(world + ": its true segments are not known; " + truth +
                             " (x1,y1,x2,y2) must stand beside it");
  }
  return scoreAgainstWorld(readSegments(truth), map);
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
    const auto map = readSegments(options->map);
    const LogScore score =
        options->log.empty() ? evaluateWorld(options->world, map) : evaluateLog(options->log, map);
    const std::string text = toJson(score).dump(1) + "\n";
    if (options->out.empty()) {
      std::fputs(text.c_str(), stdout);
    } else {
      writeFile(options->out, text);
    }
  });
}

}  // namespace cca::apps
