// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cca {

/// What chose the next goal; see docs/exploration.md.
enum class DecisionRule {
  kScore,      ///< the best score of all places
  kInPassing,  ///< on the way to the place of the best score
  kFrontier,   ///< the best score of the places at frontiers: strategies of others
  kNone,       ///< no goal is left: the exploration ends
};

/// A place that was weighed in a decision.
struct Candidate {
  Eigen::Vector2d place_map;    ///< m, map frame: where to look from
  Eigen::Vector2d look_at_map;  ///< m, map frame: what it is there to show
  double expected;              ///< m^2, that will be seen from there
  double way;                   ///< m, of the shortest known way
  double score;                 ///< scoreOf(), the more the better
};

/// A decision of the global planner with what it was made of: for people and files.
struct ExplainedDecision {
  Eigen::Vector2d robot_map;  ///< m, map frame
  DecisionRule rule;
  /// The best of all places and the best that show something else, two metres from each other at
  /// least; twelve at most.
  std::vector<Candidate> candidates;
  std::optional<std::size_t> chosen;  ///< of the candidates; none where no goal is left
  std::string reason;
};

/// Takes each decision when it is made.
using DecisionObserver = std::function<void(const ExplainedDecision&)>;

}  // namespace cca
