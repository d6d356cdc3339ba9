// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// No 2-D laser measures finer than this [m]; keeps noise-free simulations well posed.
inline constexpr double kFinestSigma = 1e-3;

/// Standard deviation over the median of |x|, x normal.
inline constexpr double kMedianToSigma = 1.4826;
/// Of a - 2 b + c, over that of each: sqrt(1 + 4 + 1).
inline constexpr double kSecondDifference = 2.449489742783178;
/// Deviations within which a line explains a return.
inline constexpr double kGates = 3.0;

/// Variances [m^2] of a point that stands for a place on a line.
struct LineNoise {
  double across = 0.0;  ///< > 0, of its distance from the line
  double along = 0.0;   ///< of its place on the line
};

/// What one laser point is worth: how far it may lie from the truth, along and across its beam.
struct PointNoise {
  double range_sigma = 0.0;    ///< m, along the beam
  double bearing_sigma = 0.0;  ///< rad, of the beam's direction
  double straightness = 0.0;   ///< m, of what the beam meets; counts where it is the larger

  /// Noise of `point` (sensor frame) as seen from a line of unit `direction`.
  ///
  /// A beam that grazes the line carries its range noise along the line, its bearing noise across.
  LineNoise onLine(const Eigen::Vector2d& point, const Eigen::Vector2d& direction) const {
    const double along = point.dot(direction);
    return onLine(point.squaredNorm(), along * along);
  }
  /// The same for a direction given by its double angle.
  LineNoise onLine(const Eigen::Vector2d& point, const PrincipalAxis& axis) const {
    const double xx = point.x() * point.x(), yy = point.y() * point.y();
    const double turned = (xx - yy) * axis.cos_2 + 2.0 * point.x() * point.y() * axis.sin_2;
    return onLine(xx + yy, 0.5 * (xx + yy + turned));
  }
  /// The largest variance [m^2] across any line, of points up to sqrt(farthest_sq) [m] away.
  double mostAcross(double farthest_sq) const {
    return wallVariance() + bearing_sigma * bearing_sigma * farthest_sq +
           kFinestSigma * kFinestSigma;
  }

 private:
  double wallVariance() const {
    return std::max(range_sigma * range_sigma, straightness * straightness);
  }
  LineNoise onLine(double range_sq, double along_sq) const {
    const double grazing = range_sq > 0.0 ? std::clamp(along_sq / range_sq, 0.0, 1.0) : 0.0;
    const double range_variance = range_sigma * range_sigma;
    return {wallVariance() * (1.0 - grazing) + bearing_sigma * bearing_sigma * along_sq +
                kFinestSigma * kFinestSigma,
            range_variance * grazing};
  }
};

/// The noise of a laser, estimated from one scan alone: the program has no noise parameter.
///
/// Along a straight wall the inverse range q is harmonic in the bearing,
/// q(i-1) + q(i+1) = 2 cos(dphi) q(i), whatever the distance and the incidence. Hence
/// e(i) = r(i)^2 (q(i-1) - 2 cos(dphi) q(i) + q(i+1)) is noise alone, of variance near 6 sigma^2,
/// and sigma = 1.4826 median|e| / sqrt 6, over the half of the beams where the ranges slope least:
/// corners and depth jumps are the minority that the median ignores. It is floored at the standard
/// deviation of rounding to the scan's range quantum. The bearing noise is that of a beam somewhere
/// within a quarter of its sector, dphi / 4 sqrt 12. Deviation: plain second differences of the
/// ranges take the curvature r(phi) of a wall for noise.
///
/// @return  sigma of at least kFinestSigma; that floor where no three neighbours have returns.
/// Cost: O(N).
PointNoise rangeNoise(const Scan& scan);

/// A scan whose range noise is averaged over neighbouring beams, as far as one small patch of a
/// surface has them.
///
/// A beam is averaged with the pairs of beams at equal distance to its left and right whose ranges
/// lie on a line with its own, within 3 sigma: an inclined wall stays where
/// it is, a thin pole or an edge in front of others is not averaged away. Where the mean lies
/// clearly farther than the beam itself, the nearer side's mean is taken: an error is one to the
/// safe side. The patch is 3 cm to each side, and no larger than it takes to bring sigma down to 5
/// mm.
///
/// @param range_sigma  m, of the scan: see rangeNoise().
/// Cost: O(beams * patch); a scan of less noise than that is returned as it is.
Scan smoothScan(const Scan& scan, double range_sigma);

}  // namespace cca
