// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/sensing/past_scans.hpp"
#include "cca_mrpt/sensing/sweep_motion.hpp"
#include "slam/motion_prior.hpp"
#include "slam/surface_matching.hpp"

namespace cca {

/// What is believed of the motion during a sweep: in either half alike, and by itself.
struct SweepBelief {
  SweepHalves motion;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< 1/m^2, 1/(m rad), 1/rad^2; of a half
  double change_share = 1.0;                              ///< see MotionPrior::changeShare()
};

struct SweepFit {
  SweepHalves motion;
  /// How far the change of motion that the wheels tell lies from the one that the scan shows by
  /// itself, times the former, weighed by what the scan knows: in the mean the variance of the
  /// wheels, since these and the scan err independently. And what the belief expects of it.
  double change_error = 0.0, expected_change_error = 0.0;
};

/// What that by which a sweep was undone is worth: the wheels' motion, or that of the scans before.
SweepBelief sweepBelief(const SweepHalves& undone_by, const MotionPrior& prior, bool by_wheels);

/// The motion within the sweep that lets the scan fit its surroundings best.
///
/// A scan whose sweep was undone by a wrong motion is bent: what its first beams, its middle ones
/// and its last ones see cannot all fit. The pose in the middle of the sweep and the motion in
/// either half are estimated together, by Gauss-Newton on the distances of matchQuadric() (elastic
/// matching, after the continuous-time ICP of Dellenbach et al. 2022), held to what is believed of
/// each. A velocity that changes within the sweep looks much like another heading. Wheels err most
/// in it, and it is mostly nil: a change that scan and wheels do not tell from none is held to none
/// by a prior of Cauchy's kind, as wide as they tell it.
///
/// @param query   of a scan, undone by `sweep`.
/// @param start   of the sensor in the middle of the sweep: where the match begins.
/// @param prior   of that pose, without this scan.
/// @param belief  of the motion within, without this scan.
/// @return        the motion; nothing where less than half of the returns were paired.
/// Cost: four matches.
std::optional<SweepFit> matchSweep(const ScanSurface& query, const SweptScan& sweep,
                                   const Pose2& start, const PoseBelief& prior,
                                   const SweepBelief& belief,
                                   const std::vector<PlacedSurface>& references);

/// A surface that was undone by `sweep.motion`, as it is by another motion that differs little: to
/// the first order of the difference.
void bendBy(const SweepHalves& motion, const SweptScan& sweep, ScanSurface& surface);

/// The same where somebody else knows the poses: among the last scans kept.
/// @param analysed      of the next scan, undone by `sweep`.
/// @param T_map_sensor  where it was taken, about as well as the others.
std::optional<SweepHalves> matchSweep(const AnalysedScan& analysed, const SweptScan& sweep,
                                      const Pose2& T_map_sensor, const PastScans& past);

}  // namespace cca
