// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "slam/surface_matching.hpp"

namespace cca {

/// The motion of a laser while it took a scan, from the first beam to the last: `step`, in its
/// frame in the middle of the sweep, and how well that is known.
struct SweepBelief {
  Pose2 step;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< 1/m^2, 1/(m rad), 1/rad^2
};

/// The motion within the sweep that lets the scan fit its surroundings best.
///
/// A scan whose sweep was undone by a wrong motion is bent: what its first beams and its last ones
/// see cannot both fit. The pose in the middle of the sweep and the motion within are estimated
/// together, by Gauss-Newton on the distances of matchQuadric() (elastic matching, after the
/// continuous-time ICP of Dellenbach et al. 2022), held to what is believed of each.
///
/// @param query   of a scan, its sweep undone by `undone_by`.
/// @param sense   1: beams followed one another counter-clockwise; -1: clockwise.
/// @param start   of the sensor in the middle of the sweep: where the match begins.
/// @param prior   of that pose, without this scan.
/// @param belief  of the motion within, without this scan.
/// @return        the motion; nothing where nothing was paired.
/// Cost: three matches.
std::optional<Pose2> matchSweep(const ScanSurface& query, double sense, const Pose2& undone_by,
                                const Pose2& start, const PoseBelief& prior,
                                const SweepBelief& belief,
                                const std::vector<PlacedSurface>& references);

}  // namespace cca
