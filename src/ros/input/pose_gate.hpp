// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// Keeps leaps of the localisation out of the map: a robot drives, it does not leap.
///
/// A pose further from the last good one than a robot can have driven since is held back. If the
/// poses come back, the leap is forgotten; if they stay together at the new place for a second,
/// that place is believed (the localisation has found itself, or somebody has carried the robot).
class PoseGate {
 public:
  enum class Verdict {
    kPlausible,  ///< use it
    kHeld,       ///< do not use it, and do not drive by it
    kMoved,      ///< use it: the place has changed for good
  };

  /// @param time  s, never falling.
  Verdict check(const Pose2& pose, double time);

 private:
  struct Fix {
    Pose2 pose;
    double time;
  };
  static bool reachable(const Fix& from, const Fix& to);

  std::optional<Fix> good_, candidate_;
  double candidate_since_ = 0.0;
};

}  // namespace cca
