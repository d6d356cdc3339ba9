// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// How a laser hangs otherwise than somebody tells.
struct MountError {
  Pose2 T_true_told;             ///< the true place on the robot is this times the told one
  double sigma = 0.0;            ///< m, of its position; infinite where the robot has hardly turned
  double turn_sigma = HUGE_VAL;  ///< rad; infinite where it has hardly driven
};

/// Of a laser whose scans tell how it moved, on a robot whose wheels tell how that moved: hand-eye
/// calibration. With a wrong place of the laser, a robot that drives ahead seems to go sideways,
/// and one that turns on the spot to go in a circle. By least squares over all steps, in turns: the
/// position with the rotation held, the rotation and the wheels' scale with the position held.
///
/// @param by_scans   T_fixed_robot of each scan, as the told place makes it of the laser's.
/// @param by_wheels  the same of the wheels, in any frame that stays.
/// @return           nothing of fewer than ten steps.
std::optional<MountError> mountError(const std::vector<Pose2>& by_scans,
                                     const std::vector<Pose2>& by_wheels);

}  // namespace cca
