// SPDX-License-Identifier: BSD-3-Clause
#include "slam/map_part.hpp"

#include <algorithm>
#include <vector>

namespace cca {

void MapPart::chooseLargest(const PoseGraph& graph) {
  std::vector<int> frames_of(static_cast<std::size_t>(graph.size()), 0);
  for (int k = remembered_; k < graph.size(); ++k) {
    ++frames_of[static_cast<std::size_t>(graph.part(k))];
  }
  part_ =
      static_cast<int>(std::max_element(frames_of.begin(), frames_of.end()) - frames_of.begin());
}

bool MapPart::isLost(const PoseGraph& graph) const {
  return hasDriven(graph) && !holds(graph, graph.size() - 1);
}

bool MapPart::isInMemory(const PoseGraph& graph) const {
  return remembered_ == 0 || !hasDriven(graph) || holds(graph, 0);
}

std::optional<int> MapPart::partToJoin(const PoseGraph& graph, int frame) const {
  if (frame < remembered_ && hasDriven(graph)) return std::nullopt;
  if (!holds(graph, frame)) return part_;
  if (!isInMemory(graph)) return graph.part(0);
  return std::nullopt;
}

}  // namespace cca
