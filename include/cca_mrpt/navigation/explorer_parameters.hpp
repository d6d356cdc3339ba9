// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>

namespace cca {

/// How the next goal is chosen, among view points with their way and gain.
enum class Strategy {
  kViewTour,         ///< what is expected to be seen, exp(-0.2 way), of all places: ours
  kGreedy,           ///< the frontier of the largest gain: the paper's Step 0
  kNearestFrontier,  ///< the shortest way [Yamauchi 1997]
  kGainDistance,     ///< gain exp(-0.2 way) [Gonzalez-Banos & Latombe 2002]
  /// The most expected information per metre of way, after [Amigoni & Caglioti 2010].
  /// Deviation: the information is the unknown area in view alone; theirs adds the re-sensing of
  /// known boundaries, which is nothing to a robot whose pose is known.
  kInformation,
};

/// As options and files name them.
inline constexpr std::pair<const char*, Strategy> kStrategyNames[] = {
    {"view_tour", Strategy::kViewTour},
    {"greedy", Strategy::kGreedy},
    {"nearest_frontier", Strategy::kNearestFrontier},
    {"gain_distance", Strategy::kGainDistance},
    {"information", Strategy::kInformation}};

struct GlobalPlannerParameters {
  Strategy strategy = Strategy::kViewTour;
  double smallest_gain = 0.1;         ///< m^2, frontiers that promise less are left
  std::size_t smallest_frontier = 3;  ///< cells, likewise
  double worth = 36.0;                ///< m of way that an unseen square metre is worth
};

/// What leads Tangent Bug to the goals of the exploration.
enum class PathKind {
  kKnownSpace,  ///< the corners of the shortest known path
  kPaper,       ///< the goal alone: straight to it
};

/// As options and files name them.
inline constexpr std::pair<const char*, PathKind> kPathNames[] = {
    {"known_space", PathKind::kKnownSpace}, {"paper", PathKind::kPaper}};

struct ExplorerParameters : GlobalPlannerParameters {
  PathKind path = PathKind::kKnownSpace;
  bool return_to_start = false;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(ExplorerParameters& p, Field&& field) {
  field("strategy", p.strategy, kStrategyNames,
        "how the next goal is chosen; greedy is the paper's");
  field("path", p.path, kPathNames,
        "way-points along what is known to be free, or (paper) Tangent Bug straight to the goal");
  field("worth", p.worth, 0.0, 1e6, "m/m^2",
        "way that an unseen square metre is worth: exploration ends when nothing that is "
        "left is worth its way");
  field("smallest_gain", p.smallest_gain, 0.0, 100.0, "m^2",
        "exploration ends when no reachable frontier promises more");
  field("return_to_start", p.return_to_start, "drive back to where it began when all is explored");
}

}  // namespace cca
