// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/sensing/past_scans.hpp"
#include "cca_mrpt/sensing/sweep_motion.hpp"
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
/// @return        the motion; nothing where less than half of the returns were paired.
/// Cost: three matches.
std::optional<Pose2> matchSweep(const ScanSurface& query, double sense, const Pose2& undone_by,
                                const Pose2& start, const PoseBelief& prior,
                                const SweepBelief& belief,
                                const std::vector<PlacedSurface>& references);

/// The same where somebody else knows the poses: among the last scans kept.
/// @param analysed      of the next scan, undone by `sweep`.
/// @param T_map_sensor  where it was taken, about as well as the others.
std::optional<Pose2> matchSweep(const AnalysedScan& analysed, const SweptScan& sweep,
                                const Pose2& T_map_sensor, const PastScans& past);

}  // namespace cca
