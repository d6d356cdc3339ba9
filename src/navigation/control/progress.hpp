// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cca_mrpt/motion/robot.hpp"

namespace cca {

/// The clock of progress: how long there has been none. Times are in seconds and never fall.
class ProgressClock {
 public:
  /// There is progress now, or an excuse for none.
  void restart(double time) { since_ = time; }
  /// Progress is expected from now on, unless it is already.
  void run(double time) { since_ = since_.value_or(time); }
  /// None is expected.
  void stop() { since_.reset(); }

  /// Whether it has run for longer than that. @param patience  s.
  bool isOver(double patience, double time) const { return since_ && time - *since_ > patience; }

 private:
  std::optional<double> since_;  ///< s
};

/// Tells whether the robot gets on along its ways: what is left of one should become shorter.
class PathProgress {
 public:
  /// Notes what is left of the way to a goal; once a step.
  /// @param goal  its number: another one has all the time, that of its way at a fifth of full
  ///              speed and half a minute more.
  /// @param way   corners, m, map frame, from the robot on. One that becomes longer at a stroke is
  ///              another way to the same goal. Empty: nothing is noted.
  /// @param looks_around  whether the robot is to turn all around: it has the time of it, too.
  void note(int goal, const std::vector<Eigen::Vector2d>& way, double time,
            const RobotParameters& robot, bool looks_around = false);
  static constexpr double kLookAround = 0.5;  ///< of the full turning rate, while looking around
  /// s; who stands in the path for a moment may leave, and so may the trace of who passed.
  static constexpr double kPatience = 10.0;

  /// Standing still by order is no failure: the time since the last call does not count.
  void pauseTimers(double time);

  /// The map was corrected: whatever way comes next is the present one, as it lies now.
  void correctPath() { is_corrected_ = true; }

  /// Whether what is left has not become shorter for ten seconds and a whole turn on the spot. Then
  /// the patience starts anew.
  bool isStuck(double time, const RobotParameters& robot);

  /// Whether the time of the goal is over.
  bool isOverdue(double time) const { return time > deadline_; }

  /// What was left when the robot was as near as it came: its beginning is where it got no farther.
  const std::vector<Eigen::Vector2d>& shortest() const { return shortest_; }

 private:
  std::optional<int> goal_;
  std::vector<Eigen::Vector2d> shortest_;
  double least_ = 0.0, last_ = 0.0;  ///< m: length of the shortest, and at the last step
  bool is_corrected_ = false;        ///< since then
  ProgressClock clock_;
  double deadline_ = 0.0, time_ = 0.0;  ///< s; the time of the last call
};

/// Notices that the robot gets nowhere, whatever way it takes: it neither leaves a place nor walks
/// on along a boundary.
class WalkProgress {
 public:
  /// Another boundary is followed, or the same one the other way: its length begins at zero, and it
  /// has the whole patience.
  void startWalk(double time);

  /// Standing still by order is no failure.
  void pauseTimers(double time) { clock_.restart(time); }

  /// @param x_map   m, the robot. @param length  m, walked along the boundary so far.
  /// @param excused whether the robot waits for somebody: that time does not count.
  /// @return        true where there has been no progress for kPatience; then it starts anew.
  bool isStuck(const Eigen::Vector2d& x_map, double length, double time, bool excused);

  static constexpr double kPatience = 6.0;  ///< s; a whole turn on the spot takes 4.5 s

 private:
  std::optional<Eigen::Vector2d> x_map_;  ///< m, when it last got on
  double length_ = 0.0;                   ///< m, likewise
  ProgressClock clock_;
};

}  // namespace cca
