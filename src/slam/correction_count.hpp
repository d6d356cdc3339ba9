// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/slam/pose_graph.hpp"

namespace cca {

/// Counts corrections of the past, for whoever holds a map made from it.
class CorrectionCount {
 public:
  int version() const { return version_; }
  /// A node has come to the graph, at this pose.
  void add(const Pose2& T_map_node) { at_version_.push_back(T_map_node); }
  /// What belongs to the map has changed, wherever it stands.
  void count() { ++version_; }
  /// Counts a correction where a pose has moved by more than 5 cm since the last one.
  /// Cost: O(n) of the nodes.
  void update(const PoseGraph& graph);

 private:
  std::vector<Pose2> at_version_;
  int version_ = 0;
};

}  // namespace cca
