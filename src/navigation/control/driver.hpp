// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cca_mrpt/navigation/observation.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"
#include "motion/commanded_motion.hpp"
#include "navigation/goal_outcome.hpp"
#include "navigation/world/world_model.hpp"

namespace cca {

/// What a driver is to do.
struct DriveTask {
  int goal = 0;                                     ///< its number: another one has all its time
  Eigen::Vector2d p_map = Eigen::Vector2d::Zero();  ///< m, the goal
  std::vector<Eigen::Vector2d> path{};              ///< m, map frame: corners, the robot first
  bool has_path = true;                             ///< false: to wait until there is one
  std::optional<Eigen::Vector2d> look_at_map{};     ///< m: to be looked at from the goal
  std::optional<double> heading{};                  ///< rad, map frame, at the goal
  bool looks_around = false;                        ///< to turn all around at the goal
  bool goes_straight = false;  ///< by Tangent Bug alone, not from corner to corner
  Eigen::Vector2d start_map = Eigen::Vector2d::Zero();  ///< m, where the robot was put down
};

/// What drives between the robot and its goals, and tells what has become of them.
class Driver {
 public:
  virtual ~Driver() = default;

  struct Command {
    Velocity velocity;
    std::optional<Pose2> T_map_goal{};  ///< for somebody else who drives
  };
  /// One step towards a goal.
  virtual Command drive(const DriveTask& task, const Observation& seen,
                        const WorldModel& world) = 0;

  /// What has become of the goal of the last step; told once.
  virtual GoalOutcome takeOutcome() = 0;

  /// Standing still by order is no failure. To be called at each moment [s] of it.
  virtual void pauseTimers(double time) = 0;
  /// The map was corrected.
  virtual void correct(const PastScans& past) = 0;
  /// What was sent to the base in the end. @param measured  velocity now. @param time  s.
  virtual void noteSent(const Velocity& command, const Velocity& measured, double time) = 0;
  /// The robot moves by other parameters from now on; its radius and margin stay.
  virtual void changeMotion(const RobotParameters& robot) = 0;

  /// The next scan without what is known to move: those beams tell nothing.
  virtual Scan withoutMovers(Scan scan) const { return scan; }
  /// Whether it drives only where the robot's pose is known.
  virtual bool needsPose() const = 0;
  /// What the odometry has shown of how the base obeys.
  virtual const ActuationModel& actuation() const = 0;
};

}  // namespace cca
