// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"
#include "cca_mrpt/motion/robot.hpp"

namespace cca {

/// What the base was told of late, and when: commands that act late are still under way.
class SentCommands {
 public:
  /// @param time  s. A second command at the time of the last one replaces it; after a gap of more
  ///              than kKept, or a step back in time, it is the only one.
  void add(const Velocity& command, double time);

  /// The last command that was sent by then; none where that is not known.
  std::optional<Velocity> at(double time) const;

  static constexpr double kKept = 1.2;  ///< s; the longest latency, and a scan that came late

 private:
  struct Sent {
    double time;
    Velocity command;
  };
  std::deque<Sent> sent_;
};

/// A velocity after dt [s] on the way to a command, at what the base can do. One of another sign is
/// braked first.
/// @param brakes  m/s^2, rad/s^2 as Velocity: how fast the speed falls.
/// @param speeds_up  how fast it rises.
Velocity obey(const Velocity& velocity, const Velocity& command, const Velocity& speeds_up,
              const Velocity& brakes, double dt);

/// How a base obeys: how late a command acts, and how hard it brakes, from what its odometry shows.
///
/// For each of a grid of latencies and of shares of the accelerations, the velocity shown by one
/// observation predicts the next one; squared errors, in units of an odometry's, are added up for
/// the last hundred observations or so. A latency stays possible while its sum is not worse than
/// the least by more than chance. Where the base does not respond at all nothing is learned.
class ActuationModel {
 public:
  /// Until something is shown, the latency is believed to within kUnsure of the robot's.
  explicit ActuationModel(const RobotParameters& robot);

  /// The parameters that all of this starts from; the only copy below an Explorer.
  const RobotParameters& robot() const { return robot_; }
  /// The robot moves by other parameters from now on. What was learned is forgotten where
  /// accelerations or latency change.
  void changeMotion(const RobotParameters& robot);

  /// @param sent      until now. @param measured  the velocity now.
  /// @param time      s; gaps of more than 0.3 s are passed over.
  /// Cost: some 20 us.
  void observe(const SentCommands& sent, const Velocity& measured, double time);

  double latency() const { return latency_; }    ///< s, the best
  double earliest() const { return earliest_; }  ///< s, of those that are possible
  double latest() const { return latest_; }      ///< s
  /// Whether the possible ones lie close together.
  bool knowsLatency() const { return latest_ - earliest_ <= kSure; }
  /// m/s^2 and rad/s^2, the hardest that fits, not more than the robot's parameters.
  Velocity brakes() const;
  /// What a standstill is reckoned with: the same, but half of the linear parameter at most.
  Velocity reliableBrakes() const;

  static constexpr double kUnsure = 0.15;  ///< s, from what was told: farther off has to be shown
  static constexpr double kSure = 0.1;     ///< s, a control period: within it they count as one

 private:
  /// Up to .6 s, and down to a fifth of the brakes.
  static constexpr std::size_t kLatencies = 25, kShares = 8;
  static constexpr double kStep = 0.025;  // s, between two latencies: a quarter of a control period
  // Of the accelerations of the robot's parameters: those that the base may in truth have.
  static constexpr std::array<double, kShares> kShare{1.0, 0.85, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2};
  enum Motion : std::size_t { kDrivesFaster, kBrakes, kTurnsFaster, kTurnsLess, kMotions };
  /// Squared errors by latency, motion that was asked for, share of the acceleration.
  using Sums = std::array<std::array<std::array<double, kShares>, kMotions>, kLatencies>;

  void addErrors(const SentCommands& sent, const Velocity& measured, double time);
  void beginPending(const Velocity& measured, double time);
  void takePending();
  void conclude();
  double shareOf(Motion motion) const;
  double sumOf(std::size_t latency) const;

  RobotParameters robot_;
  Sums sums_{}, pending_{};  ///< pending: until the base has responded
  double count_ = 0.0, pending_count_ = 0.0, pending_since_ = 0.0;
  Velocity pending_from_;
  std::optional<Velocity> last_;
  double last_time_ = 0.0;
  std::size_t best_ = 0;
  double latency_ = 0.0, earliest_ = 0.0, latest_ = 0.0;
};

/// Where the robot is when a command begins to act.
struct PredictedState {
  Pose2 T_now_then;    ///< by the commands under way
  Velocity velocity;   ///< then
  double delay = 0.0;  ///< s from now
};

/// Follows the commands that are under way, and learns from what they do how the base obeys.
class CommandedMotion {
 public:
  explicit CommandedMotion(const RobotParameters& robot) : actuation_(robot) {}

  const RobotParameters& robot() const { return actuation_.robot(); }
  /// See ActuationModel::changeMotion().
  void changeMotion(const RobotParameters& robot) { actuation_.changeMotion(robot); }

  /// To be called before the command for this moment is chosen. @param measured  velocity now; what
  /// no robot of these limits can have (half as fast again, or not finite) is passed over.
  /// @param time  s, never falling.
  void observe(const Velocity& measured, double time);
  /// The command that goes out at the time of the last observation; the last word counts.
  void note(const Velocity& command) { sent_.add(command, time_); }

  /// The command chosen now acts here: after the robot's latency, or the one it has shown,
  /// whichever is longer.
  PredictedState expected() const { return after(latency()); }
  /// The same if it acted as early, and as late, as is still possible; empty where that is known.
  std::vector<PredictedState> latencyHypotheses() const;

  /// The robot's parameters, with accelerations that it can brake with.
  RobotParameters believed() const;
  double latency() const { return std::max(robot().latency, actuation_.latency()); }  ///< s
  /// Whether that is no more than half a control period.
  bool actsAtOnce() const;
  double time() const { return time_; }  ///< s, of the last observation
  /// s, how long a command stands until the next one: the longest time between two of the last six
  /// observations, 0.1 to 1.
  double period() const;
  const ActuationModel& actuation() const { return actuation_; }

 private:
  PredictedState after(double latency) const;

  SentCommands sent_;
  ActuationModel actuation_;
  Velocity measured_;
  double time_ = -1.0;
  std::deque<double> intervals_;  ///< s, the last ones
};

}  // namespace cca
