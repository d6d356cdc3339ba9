// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "mapping/map_noise.hpp"
#include "mapping/wall.hpp"

namespace cca {

/// How well a piece of a wall is known: covariance of the lateral offset [m] at its middle and of
/// its direction [rad].
///
/// Five errors add up. That of the ranges: the bins' mean points err by the scatter of the wall's
/// own returns over their number. What is not straight: the residuals of neighbouring bins are then
/// larger than that, and alike; as a first-order autoregression of coefficient rho they are worth
/// (1 - rho) / (1 + rho) of their number. That of the poses: scans share nothing but the wall, and
/// each has shifted and turned all of it. That of a wall seen from both sides as one: a face lies
/// half a thickness off, which is what its returns scatter by beyond the ranges. That of the bins:
/// a return falls into the bin of its noisy place. At distance D a beam that meets the wall at
/// angle phi from its normal errs along it, too; returns lie the closer the nearer, hence those of
/// one bin lie sigma^2 sin^2(2 phi) / (2 D) behind the wall in the mean. Over all phi that is
/// sigma^2 / (4 D), or half the variance across the wall over D: .1 mm at 3 cm, 1.3 mm at 10 cm.
/// @param piece  one of wall.pieces, from start to end.
/// Cost: O(bins of the piece).
Eigen::Matrix2d covarianceOf(const Wall& wall, const LineSegment& piece, const MapNoise& noise);

}  // namespace cca
