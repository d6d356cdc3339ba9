// SPDX-License-Identifier: BSD-3-Clause
#include "decision_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace cca::apps {
namespace {

double toMillis(double value) { return std::round(value * 1e3) / 1e3; }

const char* nameOf(DecisionRule rule) {
  switch (rule) {
    case DecisionRule::kScore:
      return "score";
    case DecisionRule::kInPassing:
      return "in_passing";
    case DecisionRule::kFrontier:
      return "frontier";
    case DecisionRule::kNone:
      break;
  }
  return "none";
}

}  // namespace

void DecisionFile::add(const ExplainedDecision& decision, double time, double distance) {
  const Eigen::Vector2d robot_map = origin_ + decision.robot_map;
  nlohmann::ordered_json line{
      {"time_s", toMillis(time)},       {"distance_m", toMillis(distance)},
      {"x_m", toMillis(robot_map.x())}, {"y_m", toMillis(robot_map.y())},
      {"rule", nameOf(decision.rule)},  {"chosen", nullptr},
      {"reason", decision.reason},      {"candidates", nlohmann::ordered_json::array()}};
  if (decision.chosen) line["chosen"] = *decision.chosen;
  for (const Candidate& candidate : decision.candidates) {
    const Eigen::Vector2d place_map = origin_ + candidate.place_map;
    const Eigen::Vector2d look_at_map = origin_ + candidate.look_at_map;
    line["candidates"].push_back({{"x_m", toMillis(place_map.x())},
                                  {"y_m", toMillis(place_map.y())},
                                  {"look_at_x_m", toMillis(look_at_map.x())},
                                  {"look_at_y_m", toMillis(look_at_map.y())},
                                  {"promise_m2", toMillis(candidate.expected)},
                                  {"way_m", toMillis(candidate.way)},
                                  {"score", toMillis(candidate.score)}});
  }
  lines_ += line.dump() + "\n";
}

void DecisionFile::commit() { writeFile(path_, lines_); }

}  // namespace cca::apps
