// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "cca_mrpt/mapping/pose2.hpp"
#include "cca_mrpt/navigation/drive/robot.hpp"
#include "cca_mrpt/navigation/drive/sent_commands.hpp"
#include "cca_mrpt/navigation/drive/shown_motion.hpp"

namespace cca {

/// Where the robot is when a command begins to act.
struct Onset {
  Pose2 T_now_then;    ///< by the commands under way
  Velocity velocity;   ///< then
  double delay = 0.0;  ///< s from now
};

/// Follows the commands that are under way, and learns from what they do how the base obeys.
class CommandedMotion {
 public:
  explicit CommandedMotion(const RobotParameters& robot) : robot_(robot), shown_(robot) {}

  /// See Explorer::changeMotion().
  void changeMotion(const RobotParameters& robot);

  /// To be called before the command for this moment is chosen. @param measured  velocity now.
  /// @param time  s, never falling.
  void observe(const Velocity& measured, double time);
  /// The command that goes out at the time of the last observation; the last word counts.
  void note(const Velocity& command) { sent_.add(command, time_); }

  /// The command chosen now acts here: after the robot's latency, or the one it has shown,
  /// whichever is longer.
  Onset expected() const { return after(latency()); }
  /// The same if it acted as early, and as late, as is still possible; empty where that is known.
  std::vector<Onset> otherwise() const;

  /// The robot's parameters, with accelerations that it can brake with.
  RobotParameters believed() const;
  double latency() const { return std::max(robot_.latency, shown_.latency()); }  ///< s
  double time() const { return time_; }  ///< s, of the last observation
  const ShownMotion& shown() const { return shown_; }

 private:
  Onset after(double latency) const;

  RobotParameters robot_;
  SentCommands sent_;
  ShownMotion shown_;
  Velocity measured_;
  double time_ = -1.0;
};

}  // namespace cca
