// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "motion/commanded_motion.hpp"

namespace cca {

/// The velocity that leads a differential drive straight to a point: it turns towards it, on the
/// spot where it points more than kTurnOnTheSpot away, and drives the faster the better it points.
///
/// @param target_robot   m, robot frame.
/// @param stop_at_target whether to brake ahead of it with the robot's deceleration.
/// @return  within the robot's velocity limits; acceleration is limited by safeVelocity().
Velocity velocityTowards(const Eigen::Vector2d& target_robot, bool stop_at_target,
                         const RobotParameters& robot);

inline constexpr double kTurnOnTheSpot = 0.7;  ///< rad, 40 degrees; the speed falls to 0 there
/// m/s, as measured: a robot that is slower stands. Odometry is noisy.
inline constexpr double kStands = 0.05;

/// A point that the robot must not touch.
struct Hazard {
  Eigen::Vector2d p_robot;     ///< m, robot frame
  double closing_speed = 0.0;  ///< m/s, how fast it may come nearer (0: it stands)
  double allowance = 0.0;      ///< m, by which it may be inside the radius
};

/// The direction nearest to a wanted one in which the robot comes no nearer to a hazard that it is
/// too near to already: towards it would be refused, and standing would keep the robot there.
/// @param bearing  rad, robot frame. @param radius  m, as for safeVelocity().
/// @return rad, robot frame; the wanted one where no hazard is too near, or every direction leads
///         nearer to one. Cost: O(hazards + square of those that are too near).
double bearingPast(const std::vector<Hazard>& hazards, double radius, double bearing);

/// The last word on what the robot does: the velocity nearest to the wanted one from which it can
/// still stop before it touches anything.
///
/// A command is safe where the motion that it starts, one control period at that command, then
/// braking both velocities with the robot's accelerations until it drives no more, keeps every
/// hazard outside the disc of `radius` less its allowance; a hazard that is inside already must not
/// come nearer. Braking at once is what the safety of the last command rests on, so it is the
/// answer where nothing else is safe. Turning on the spot is always safe for a disc.
///
/// Where the command may act earlier or later than expected, it must be safe from there, too, or at
/// least come no nearer to any hazard than braking would.
///
/// @param wanted   any; clamped to what the accelerations allow in one period.
/// @param present  the velocity now.
/// @param radius   m, the robot's radius with the least clearance that is never given up.
/// @param period   s, time between two commands.
/// @param brakes   m/s^2, rad/s^2, what braking may count on.
/// @param others   seen from where it is expected to act, delays from then.
/// Cost: O(candidates * braking steps * near hazards), some 10 us.
Velocity safeVelocity(const Velocity& wanted, const Velocity& present,
                      const std::vector<Hazard>& hazards, const RobotParameters& robot,
                      double radius, double period, const Velocity& brakes,
                      const std::vector<PredictedState>& others = {});

}  // namespace cca
