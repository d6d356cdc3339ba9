// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// What one laser point is worth: how far it may lie from the truth, along and across its beam.
struct PointNoise {
  double range_sigma = 0.0;    ///< m, along the beam
  double bearing_sigma = 0.0;  ///< rad, of the beam's direction

  /// Variance [m^2] of the distance of `point` (sensor frame) from a line of unit `direction`.
  ///
  /// A beam that grazes the line carries its range noise along the line, its bearing noise across.
  double lateralVariance(const Eigen::Vector2d& point, const Eigen::Vector2d& direction) const;
};

/// The noise of a scan, estimated from this scan alone: the program has no noise parameter.
///
/// Along a straight wall the inverse range q is harmonic in the bearing,
/// q(i-1) + q(i+1) = 2 cos(dphi) q(i), whatever the distance and the incidence. Hence
/// e(i) = r(i)^2 (q(i-1) - 2 cos(dphi) q(i) + q(i+1)) is noise alone, of variance near 6 sigma^2,
/// and sigma = 1.4826 median|e| / sqrt 6: corners and depth jumps are the minority that the median
/// ignores. It is floored at the standard deviation of rounding to the scan's range quantum.
/// The bearing noise is that of a beam somewhere within a quarter of its sector, dphi / 4 sqrt 12.
/// Deviation: plain second differences of the ranges take the curvature r(phi) of a wall for noise.
///
/// @return  sigma of at least kFinestSigma; that floor where no three neighbours have returns.
/// Cost: O(N).
PointNoise rangeNoise(const Scan& scan);

/// A wall, plastered and furnished, is straight to about this [m]: finer detail is no line's
/// concern.
inline constexpr double kStraightness = 0.035;

/// The deviations of points from a wall: the larger of what sensor and wall themselves bring.
PointNoise wallNoise(PointNoise sensor);

/// No 2-D laser measures finer than this [m]; keeps noise-free simulations well posed.
inline constexpr double kFinestSigma = 1e-3;

}  // namespace cca
