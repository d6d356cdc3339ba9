// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "slam/loop_closing.hpp"

namespace cca {

/// A loop among those that say the same.
struct LoopOfCluster {
  LoopVerdict verdict;
  bool is_believed;
  int cluster = 0;
};

/// Numbers the clusters of loops that say the same: believed ones, and others.
/// Cost: O(loops squared).
void numberClusters(const PoseGraph& graph, std::vector<LoopOfCluster>& loops);

/// What a hypothesis does to the loops of the map that stands.
struct LoopChange {
  bool is_without;  ///< else with
  int cluster;
  double first;  ///< those with more are tried first
};

/// Clusters to be left out, those first that were found in the widest windows; and to be taken in,
/// those first that most frames found. Eighteen at the most.
std::vector<LoopChange> changesOf(const std::vector<LoopOfCluster>& loops);

}  // namespace cca
