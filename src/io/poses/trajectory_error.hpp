// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

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

/// How well the visits of one place fit together: the mean error [m] of the relative position of
/// poses nearer than 3 m to each other that lie more than 30 m of way apart [Kuemmerle et al.
/// 2009]. At most some thousand pairs, evenly chosen, are asked; 0 where there is none.
double loopError(const std::vector<Pose2>& estimate, const std::vector<Pose2>& truth);

}  // namespace cca
