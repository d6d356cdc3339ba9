// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "cca_mrpt/navigation/drive/robot.hpp"

namespace cca {

/// Tells whether the robot gets on along its ways: what is left of one should become shorter.
/// Times are in seconds and never fall.
class WayProgress {
 public:
  explicit WayProgress(const RobotParameters& robot) : robot_(robot) {}

  /// See Explorer::changeMotion().
  void changeMotion(const RobotParameters& robot) { robot_ = robot_.movingAs(robot); }

  /// Notes what is left of the way to a goal; once a step.
  /// @param goal  its number: another one has all the time, that of its way at a fifth of full
  ///              speed and half a minute more.
  /// @param way   corners, m, map frame, from the robot on. One that becomes longer at a stroke is
  ///              another way to the same goal. Empty: nothing is noted.
  void note(int goal, const std::vector<Eigen::Vector2d>& way, double time);

  /// Standing still by order is no failure.
  void excuse(double time);

  /// The map has changed: whatever way comes next is another one to the same goal.
  void forgetWay() { last_ = -std::numeric_limits<double>::infinity(); }

  /// Whether what is left has not become shorter for ten seconds and a whole turn on the spot. Then
  /// the patience starts anew.
  bool isStuck(double time);

  /// Whether the time of the goal is over.
  bool isOverdue(double time) const { return time > deadline_; }

  /// What was left when the robot was as near as it came: its beginning is where it got no farther.
  const std::vector<Eigen::Vector2d>& shortest() const { return shortest_; }

 private:
  RobotParameters robot_;
  int goal_ = -1;
  std::vector<Eigen::Vector2d> shortest_;
  double least_ = 0.0, last_ = 0.0;      ///< m: length of the shortest, and at the last step
  double since_ = 0.0, deadline_ = 0.0;  ///< s
};

}  // namespace cca
