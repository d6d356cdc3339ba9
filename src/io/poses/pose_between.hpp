// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// Of a robot that goes evenly from a to b. @param share  of the way, in [0, 1].
inline Pose2 poseBetween(const Pose2& a, const Pose2& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrapAngle(a.theta + share * wrapAngle(b.theta - a.theta))};
}

}  // namespace cca
