// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cca {

/// How far a goal has got.
enum class GoalStatus {
  kUnderWay,
  kReached,      ///< the robot is as near as it gets, and looks where it was to look
  kStuck,        ///< what is left of the path has not become shorter for long
  kUnreachable,  ///< Tangent Bug's proof
  kGivenUp,      ///< its time is over, or somebody else who drives says so
};

/// What has become of the last goal: all that a driver tells the planner.
struct GoalOutcome {
  int goal = 0;  ///< its number, see Plan::goal
  GoalStatus status = GoalStatus::kUnderWay;
  /// m, map frame: what was left of the path when the robot was as near as it came. Its beginning
  /// is where it got no farther. Empty where that is not known, and where nothing failed.
  std::vector<Eigen::Vector2d> lost_path{};
};

}  // namespace cca
