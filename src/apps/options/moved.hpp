// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca::apps {

/// m; farther from one scan to the next is no drive.
inline constexpr double kLongestStep = 10.0;

/// Keeps a pose that lies 10 cm or 0.25 rad from the last one that was kept. @return whether it
/// does.
inline bool keepIfMoved(std::optional<Pose2>& last, const Pose2& now) {
  if (last && (now.position() - last->position()).norm() < 0.1 &&
      std::abs(wrapAngle(now.theta - last->theta)) < 0.25) {
    return false;
  }
  last = now;
  return true;
}

}  // namespace cca::apps
