// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "motion/commanded_motion.hpp"
#include "navigation/control/motion_control.hpp"
#include "navigation/control/progress.hpp"
#include "sensing/local_view.hpp"
#include "sensing/moving_points.hpp"

namespace cca {

/// A place to drive straight to.
struct ControlTarget {
  Eigen::Vector2d p_map;   ///< m
  bool stop_there = true;  ///< brake ahead of it
};

/// Drives to whatever the planner names, and into nothing that the scans show: the last scan, and
/// where ranges are noisy those before it.
class VelocityController {
 public:
  explicit VelocityController(const RobotParameters& robot) : motion_(robot) {}

  /// All is worked out for the place where the command begins to act (CommandedMotion).
  ///
  /// @param target     empty: to stand.
  /// @param velocity   the robot's present one, as measured.
  /// @param view       with all obstacles around that are known of.
  /// @param movers     that the scan of `view` was given to.
  /// @param clearance  m, kept from what stands: the robot's radius with the least margin.
  /// @param heeded     m, around the robot: what noisy scans show there is heeded longer.
  /// @param time       s, never falling.
  /// @return within the robot's limits.
  Velocity step(const std::optional<ControlTarget>& target, const Velocity& velocity,
                const LocalView& view, const MovingPoints& movers, double clearance, double heeded,
                double time);

  /// What was sent instead of what the last step said, or where there was none.
  void noteSent(const Velocity& command, const Velocity& velocity, double time);
  /// The robot, the commands under way, and what they have shown of the base.
  CommandedMotion& motion() { return motion_; }
  const CommandedMotion& motion() const { return motion_; }

 private:
  Velocity wanted(const std::optional<ControlTarget>& target, const LocalView& view,
                  const Pose2& T_map_robot, const std::vector<Hazard>& hazards, double clearance,
                  double time) const;
  std::vector<Hazard> hazards(const LocalView& view, const PredictedState& state,
                              const MovingPoints& movers, double clearance, double time) const;
  void noteWhetherHeld(bool is_held, double time);
  void noteWhetherPeopleStand(bool is_held, double nearest_mover, double time);
  void remember(const LocalView& view, double heeded);

  CommandedMotion motion_;
  std::deque<std::vector<Eigen::Vector2d>> lately_near_map_;  ///< by scan, where ranges are noisy
  ProgressClock held_;  ///< while it stands, wants to drive, and that is not safe
  double gets_away_until_ = -std::numeric_limits<double>::infinity();  ///< s
  ProgressClock people_stand_;  ///< while the robot stands, wants to drive, and they are in reach
  double unseen_until_ = -std::numeric_limits<double>::infinity();       ///< s
  double creeps_past_until_ = -std::numeric_limits<double>::infinity();  ///< s
};

}  // namespace cca
