// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "cca_mrpt/navigation/drive/robot.hpp"
#include "cca_mrpt/navigation/drive/sent_commands.hpp"

namespace cca {

/// How a base obeys, learned from what it was told and what its odometry showed: how late a command
/// acts, and how hard it brakes.
///
/// For each of a grid of latencies and of shares of the accelerations, the velocity shown by one
/// observation predicts the next one; squared errors, in units of what an odometry errs by, are
/// added up, and the last hundred observations or so count. A latency stays possible while its sum
/// is not worse than the least by more than chance. Where the base did not respond at all (its
/// motors are off, somebody holds it) nothing is learned.
class ShownMotion {
 public:
  /// Until something is shown, the latency is believed to within kUnsure of the robot's.
  explicit ShownMotion(const RobotParameters& robot);

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
  /// The same, but half of the parameter at most until the robot has braked harder.
  Velocity provenBrakes() const;

  static constexpr double kUnsure = 0.15;  ///< s
  static constexpr double kSure = 0.1;     ///< s

 private:
  static constexpr std::size_t kLatencies = 25, kShares = 8;
  static constexpr double kStep = 0.025;  // s, between two latencies
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
  bool has_braked_ = false;
  std::size_t best_ = 0;
  double latency_ = 0.0, earliest_ = 0.0, latest_ = 0.0;
};

}  // namespace cca
