// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "cca_mrpt/navigation/drive/robot.hpp"

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

}  // namespace cca
