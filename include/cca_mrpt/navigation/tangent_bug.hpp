// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "cca_mrpt/mapping/scan.hpp"
#include "cca_mrpt/navigation/robot.hpp"

namespace cca {

enum class TangentBugState {
  kMotionToGoal,
  kBoundaryFollowing,
  kReached,
  kUnreachable,  ///< proven: the boundary has been circled
};

/// The local planner [Kamon, Rimon & Rivlin 1998], for a finite-range laser, in configuration
/// space.
class TangentBug {
 public:
  explicit TangentBug(const RobotParameters& robot) : robot_(robot) {}

  /// Starts anew towards a goal. @param goal_map  m, map frame.
  void setGoal(const Eigen::Vector2d& goal_map);

  /// One decision. @param velocity the robot's present velocity. @param time s, never falling.
  /// @return the velocity to drive with: within the robot's limits, and never into what the scan
  ///         shows; zero where the goal is reached or unreachable.
  Velocity step(const Scan& scan, const Pose2& T_map_robot, const Velocity& velocity, double time);

  TangentBugState state() const { return state_; }

 private:
  RobotParameters robot_;
  Eigen::Vector2d goal_map_ = Eigen::Vector2d::Zero();
  TangentBugState state_ = TangentBugState::kReached;
};

}  // namespace cca
