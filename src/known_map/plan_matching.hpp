// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "known_map/plan_lines.hpp"
#include "slam/scan_surface.hpp"
#include "slam/surface_matching.hpp"

namespace cca {

/// How a match is worked out.
struct PlanMatching {
  double first_reach = 0.3;   ///< m, up to PlanLines::kMostReach: how far off the pose may be
  double plan_sigma = 0.015;  ///< m, > 0: how far a piece of the plan is off, as a whole
  double share = 1.0;         ///< of its information that a scan brings which earlier ones did not
  /// How far a scan errs as a whole, map axes: its sweep was undone by wheels that err. Positive
  /// definite.
  Eigen::Matrix3d scan_covariance = Eigen::Vector3d(1e-6, 1e-6, 1e-7).asDiagonal();
};

struct PlanMatch {
  Pose2 T_map_sensor;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of the match alone, map axes
  Eigen::Matrix3d posterior = Eigen::Matrix3d::Zero();    ///< its share with the prior's
  double paired = 0.0;  ///< share of the returns that lie on the plan at the end
  double sigma = 0.0;   ///< m, rms distance of these from their pieces
  /// m^2: variance of the mean distances of whole pieces, less what their returns' noise explains;
  /// negative where too few pieces tell.
  double piece_variance = -1.0;
  /// m, rad: how far the lines that the scan met are off together, of what each tells: the map has
  /// been bent by the poses that it was made from, walls and all.
  LineSigma map_sigma;
};

/// Matches the returns of a scan to the lines of a plan: Gauss-Newton on their distances from the
/// nearest piece that faces alike [Censi 2008], robust (Cauchy), the reach shrinking to what the
/// noise needs.
///
/// The returns on one piece of the plan have one error in common, that of the plan there, besides
/// their own: e_i = J_i x + b + noise_i. With b taken out (Woodbury) a piece with n returns is
/// worth J' J / (sigma^2 + n plan_sigma^2) and no more, however many beams have met it. So the
/// covariance does not shrink below what the plan is good for.
///
/// @param prior  held to by its information, Student's t; zero: not at all.
/// @return       with paired = 0 the pose is the start's.
/// Cost: O(returns x pieces near each), 12 rounds at most.
PlanMatch matchPlan(const ScanSurface& surface, const Pose2& start, const PoseBelief& prior,
                    const PlanLines& plan, const PlanMatching& how);

}  // namespace cca
