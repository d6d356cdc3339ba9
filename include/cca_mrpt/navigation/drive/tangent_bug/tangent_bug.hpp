// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "cca_mrpt/motion/robot.hpp"
#include "cca_mrpt/navigation/drive/progress.hpp"
#include "cca_mrpt/navigation/drive/tangent_bug/boundary_follower.hpp"
#include "cca_mrpt/navigation/drive/tangent_bug/motion_to_goal.hpp"
#include "cca_mrpt/navigation/drive/tangent_bug/tangent_graph.hpp"
#include "cca_mrpt/navigation/drive/target_driver.hpp"
#include "cca_mrpt/sensing/local_view.hpp"
#include "cca_mrpt/sensing/moving_points.hpp"
#include "cca_mrpt/sensing/near_surfaces.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

enum class TangentBugState {
  kMotionToGoal,
  kBoundaryFollowing,
  kReached,
  /// The boundary has been circled; or the robot can move nowhere, or follows one boundary after
  /// the other and comes no nearer (noise and moving obstacles break the paper's proof, not its
  /// end).
  kUnreachable,
};

/// The local planner [Kamon, Rimon & Rivlin 1998], for a finite-range laser, in configuration
/// space.
class TangentBug {
 public:
  explicit TangentBug(const RobotParameters& robot) : robot_(robot), driver_(robot) {}

  /// See Explorer::changeMotion().
  void changeMotion(const RobotParameters& robot) {
    robot_ = robot;
    driver_.changeMotion(robot);
  }

  /// Starts anew towards a goal. @param goal_map  m, map frame.
  void setGoal(const Eigen::Vector2d& goal_map);

  /// Standing still by order is no failure. To be called at each moment [s] of it.
  void excuse(double time) { progress_.excuse(time); }

  /// Obstacles (m, map frame) around the robot that are known from elsewhere. Steps heed those out
  /// of the laser's view: what a narrow one saw before the robot turned or drove on.
  void setKnownObstacles(std::vector<Eigen::Vector2d> obstacles_map) {
    known_map_ = std::move(obstacles_map);
  }

  /// What other sensors have met (m, map frame), below the laser's plane or behind its back. Steps
  /// heed it wherever it lies: the laser that looks over it says nothing about it.
  void setHazards(std::vector<Eigen::Vector2d> hazards_map) {
    hazards_map_ = std::move(hazards_map);
  }

  /// One decision. @param velocity the robot's present velocity. @param time s, never falling.
  /// @return the velocity to drive with: within the robot's limits, and never into what the scan
  ///         shows; zero where the goal is reached or unreachable.
  Velocity step(const Scan& scan, const Pose2& T_map_robot, const Velocity& velocity, double time);

  /// See TargetDriver.
  void noteSent(const Velocity& command, const Velocity& velocity, double time) {
    driver_.noteSent(command, velocity, time);
  }
  const CommandedMotion& motion() const { return driver_.motion(); }

  TangentBugState state() const { return state_; }
  /// What the last step saw and chose, for pictures, markers and tests.
  const std::vector<TangentNode>& tangentGraph() const { return nodes_; }
  const std::optional<Eigen::Vector2d>& target() const { return target_; }
  double reachDistance() const { return d_reach_; }  ///< d_reach, m

 private:
  bool moverIsNear() const;
  void shutWhatIsTooNarrow();
  void observe(const Scan& scan, const Pose2& T_map_robot, double time);
  void findReach();
  bool isInVain(const Eigen::Vector2d& p_map) const;
  std::optional<Eigen::Vector2d> moveToGoal();
  std::optional<Eigen::Vector2d> startFollowing();
  std::optional<Eigen::Vector2d> followBoundary();

  RobotParameters robot_;
  Eigen::Vector2d goal_map_ = Eigen::Vector2d::Zero();
  TangentBugState state_ = TangentBugState::kReached;
  WalkProgress progress_;
  std::vector<Eigen::Vector2d> shut_map_;  ///< places in gaps that proved too narrow
  double least_distance_ = 0.0;            ///< m, between the robot and the goal, so far
  int tries_ = 0;  ///< boundaries and gaps, since the robot came nearer than ever
  std::optional<Eigen::Vector2d> started_at_map_;
  ProgressClock lost_;  ///< while the boundary that it follows is out of sight
  double time_ = 0.0;
  MovingPoints moving_points_;
  NearSurfaces near_surfaces_;
  std::vector<Eigen::Vector2d> known_map_;  ///< around the robot, from elsewhere
  std::vector<Eigen::Vector2d> hazards_map_;
  LocalView view_;
  ConfigurationSpace way_space_, trace_space_;
  std::vector<FreeRange> free_ranges_;
  std::vector<TangentNode> nodes_;
  std::optional<Eigen::Vector2d> target_;
  MotionToGoal motion_to_goal_;
  BoundaryFollower follower_;
  TargetDriver driver_;
  double d_reach_ = 0.0;
  /// A place that d_reach promised, and that was not there, found out from `distance` (m) away.
  struct InVain {
    Eigen::Vector2d p_map;
    double distance;
  };
  std::vector<InVain> in_vain_;
  Eigen::Vector2d reach_map_ = Eigen::Vector2d::Zero();  ///< the place in sight nearest to the goal
};

}  // namespace cca
