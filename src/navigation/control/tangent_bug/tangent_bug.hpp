// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "cca_mrpt/motion/robot.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "navigation/control/progress.hpp"
#include "navigation/control/tangent_bug/boundary_follower.hpp"
#include "navigation/control/tangent_bug/motion_to_goal.hpp"
#include "navigation/control/tangent_bug/tangent_graph.hpp"
#include "navigation/control/velocity_controller.hpp"
#include "sensing/local_view.hpp"
#include "sensing/moving_points.hpp"
#include "sensing/near_surfaces.hpp"

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
  explicit TangentBug(const RobotParameters& robot) : controller_(robot) {}

  /// Starts anew towards a goal. @param goal_map  m, map frame.
  void setGoal(const Eigen::Vector2d& goal_map);
  /// The next goal is another one, wherever it lies.
  void clearGoal() { pursuit_.has_goal = false; }
  std::optional<Eigen::Vector2d> goal() const {
    return pursuit_.has_goal ? std::optional<Eigen::Vector2d>(pursuit_.goal_map) : std::nullopt;
  }

  /// Standing still by order is no failure. To be called at each moment [s] of it.
  void pauseTimers(double time) { pursuit_.progress.pauseTimers(time); }

  /// What is known of around the robot at one moment.
  struct Surroundings {
    Scan scan;  ///< at T_map_sensor
    Pose2 T_map_robot;
    double range_sigma;  ///< m, of the scan's ranges
    /// m, map frame: obstacles that are known from elsewhere. Those out of the laser's view count:
    /// what a narrow one saw before the robot turned or drove on.
    std::vector<Eigen::Vector2d> known_map{};
    /// m, map frame: what other sensors have met, below the laser's plane or behind its back. It
    /// counts wherever it lies: the laser that looks over it says nothing about it.
    std::vector<Eigen::Vector2d> hazards_map{};
  };

  /// One decision. @param velocity the robot's present velocity. @param time s, never falling.
  /// @return the velocity to drive with: within the robot's limits, and never into what the scan
  ///         shows; zero where the goal is reached or unreachable.
  Velocity step(const Surroundings& surroundings, const Velocity& velocity, double time);
  /// The same by a scan alone, that nobody has analysed yet.
  Velocity step(const Scan& scan, const Pose2& T_map_robot, const Velocity& velocity, double time);

  /// Of the scans so far.
  const MovingPoints& movers() const { return moving_points_; }

  VelocityController& controller() { return controller_; }
  const VelocityController& controller() const { return controller_; }
  const RobotParameters& robot() const { return controller_.motion().robot(); }

  TangentBugState state() const { return pursuit_.state; }
  /// What the last step saw and chose, for pictures, markers and tests.
  const std::vector<TangentNode>& tangentGraph() const { return local_.nodes; }
  const std::optional<Eigen::Vector2d>& target() const { return target_; }
  double reachDistance() const { return local_.d_reach; }  ///< d_reach, m

 private:
  bool moverIsNear() const;
  void shutWhatIsTooNarrow();
  void observe(const Surroundings& surroundings, double time);
  void findReach();
  bool isInVain(const Eigen::Vector2d& p_map) const;
  std::optional<Eigen::Vector2d> moveToGoal();
  std::optional<Eigen::Vector2d> startFollowing();
  std::optional<Eigen::Vector2d> followBoundary();

  /// How far it has got towards one goal.
  struct Pursuit {
    Eigen::Vector2d goal_map = Eigen::Vector2d::Zero();
    bool has_goal = false;
    TangentBugState state = TangentBugState::kReached;
    MotionToGoal motion_to_goal;
    BoundaryFollower follower;
    WalkProgress progress;
    ProgressClock lost;  ///< while the boundary that it follows is out of sight
    double least_distance = std::numeric_limits<double>::infinity();  ///< m, to the goal, so far
    int tries = 0;  ///< boundaries and gaps, since the robot came nearer than ever
    std::optional<Eigen::Vector2d> started_at_map;
    std::vector<Eigen::Vector2d> shut_map;  ///< places in gaps that proved too narrow
    /// A place that d_reach promised, and that was not there, found out from `distance` (m) away.
    struct InVain {
      Eigen::Vector2d p_map;
      double distance;
    };
    std::vector<InVain> in_vain;
  };
  /// The local tangent graph of the last step, and what it is made of.
  struct LocalGraph {
    ConfigurationSpace way_space, trace_space;
    std::vector<FreeRange> free_ranges;
    std::vector<TangentNode> nodes;
    double d_reach = 0.0;
    Eigen::Vector2d reach_map =
        Eigen::Vector2d::Zero();  ///< the place in sight nearest to the goal
  };

  Pursuit pursuit_;
  MovingPoints moving_points_;
  NearSurfaces near_surfaces_;
  LocalView view_;
  LocalGraph local_;
  std::optional<Eigen::Vector2d> target_;
  double time_ = 0.0;
  VelocityController controller_;
};

}  // namespace cca
