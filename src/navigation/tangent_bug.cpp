// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/tangent_bug.hpp"

namespace cca {

void TangentBug::setGoal(const Eigen::Vector2d& goal_map) {
  goal_map_ = goal_map;
  state_ = TangentBugState::kMotionToGoal;
}

Velocity TangentBug::step(const Scan&, const Pose2&, const Velocity&, double) { return {}; }

}  // namespace cca
