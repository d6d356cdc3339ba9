// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/pose2.hpp"

namespace cca {

/// How far one trajectory is from another.
struct TrajectoryError {
  double rms_m = 0.0;     ///< after the rigid motion that fits best (absolute trajectory error)
  double max_m = 0.0;     ///< the same, at the worst pose
  double rms_deg = 0.0;   ///< headings, after that motion
  double at_end_m = 0.0;  ///< of the last pose, without any motion: the drift
};

/// @param estimate, truth  the same number of poses, at the same times; none: all zero.
TrajectoryError compareTrajectories(const std::vector<Pose2>& estimate,
                                    const std::vector<Pose2>& truth);

}  // namespace cca
