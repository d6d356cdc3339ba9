// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "mapping/map_noise.hpp"
#include "mapping/wall.hpp"

namespace cca {

/// How well a piece of a wall is known: covariance of the lateral offset [m] at its middle and of
/// its direction [rad].
///
/// Three errors add up. That of the ranges: the bins' mean points err by the scatter of the wall's
/// own returns over their number. What is not straight: the residuals of neighbouring bins are then
/// larger than that, and alike; as a first-order autoregression of coefficient rho they are worth
/// (1 - rho) / (1 + rho) of their number. That of the poses: scans share nothing but the wall, and
/// each has shifted and turned all of it.
/// @param piece  one of wall.pieces, from start to end.
/// Cost: O(bins of the piece).
Eigen::Matrix2d covarianceOf(const Wall& wall, const LineSegment& piece, const MapNoise& noise);

}  // namespace cca
