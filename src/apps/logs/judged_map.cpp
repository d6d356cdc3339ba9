// SPDX-License-Identifier: BSD-3-Clause
#include "judged_map.hpp"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "evaluation/sigma_score.hpp"
#include "evaluation/world_score.hpp"
#include "io/lines/line_formats.hpp"
#include "io/lines/segments_csv.hpp"

namespace cca::apps {

JudgedMap::JudgedMap(std::string lines_csv, std::string file)
    : text(std::move(lines_csv)), name(std::move(file)) {
  if (text.rfind("scan_id,", 0) == 0) {
    throw std::runtime_error(name + ": holds the lines of single scans ('extract'), not of a map");
  }
  segments = readSegments(text, name);
}

LogScore judgeByLog(LogReader& log, const JudgedMap& map) {
  std::vector<Scan> scans;
  while (auto record = log.next()) scans.push_back(std::move(record->scan));
  return scoreAgainstLog(scans, map.segments);
}

LogScore judgeByWorld(const std::string& world, const JudgedMap& map) {
  const std::string truth = truthPath(world);
  if (!std::filesystem::exists(truth)) {
    throw std::runtime_error(world + ": its true segments are not known; " + truth +
                             " (x1,y1,x2,y2) must stand beside it");
  }
  const std::vector<Segment2> walls = loadSegments(truth);
  LogScore score = scoreAgainstWorld(walls, map.segments);
  score.groups.push_back(scoreSigmas(walls, readLinesCsv(map.text, map.name)));
  return score;
}

std::string textOf(const LogScore& score) {
  nlohmann::ordered_json json;
  for (const auto& group : score.groups) {
    for (const auto& [key, value] : group.figures) {
      // Five digits behind the point, as people read and compare them.
      json[group.name][key] =
          std::isfinite(value) ? nlohmann::json(std::round(value * 1e5) / 1e5) : nullptr;
    }
  }
  return json.dump(1) + "\n";
}

}  // namespace cca::apps
