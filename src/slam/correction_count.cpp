// SPDX-License-Identifier: BSD-3-Clause
#include "slam/correction_count.hpp"

#include <algorithm>
#include <cstddef>

namespace cca {
namespace {

/// m, of a pose: about what the maps made from it can tell.
constexpr double kCorrection = 0.05;

}  // namespace

void CorrectionCount::update(const PoseGraph& graph) {
  double moved = 0.0;
  for (std::size_t k = 0; k < at_version_.size(); ++k) {
    const Pose2& pose = graph.pose(static_cast<int>(k));
    moved = std::max(moved, (pose.position() - at_version_[k].position()).norm());
  }
  if (moved <= kCorrection) return;
  for (std::size_t k = 0; k < at_version_.size(); ++k) {
    at_version_[k] = graph.pose(static_cast<int>(k));
  }
  ++version_;
}

}  // namespace cca
