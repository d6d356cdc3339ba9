// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace cca {

/// A piece of a circle, or all of it: a round pillar, a curved wall.
struct Arc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();      ///< m
  double radius = 0.0;                                   ///< m, > 0
  double start_angle = 0.0;                              ///< rad, about the centre, in [-pi, pi]
  double sweep = 0.0;                                    ///< rad, counter-clockwise, in (0, 2 pi]
  double support = 0.0;                                  ///< number of points that it stands on
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< m^2, of centre x, y, and radius

  double length() const { return radius * sweep; }
  /// The point at a share [0, 1] of the way from its start.
  Eigen::Vector2d at(double share) const;
};

/// A point of a curve, and how well it is known across the curve.
struct CurvePoint {
  Eigen::Vector2d position;  ///< m
  double variance;           ///< m^2, > 0
};

struct FittedArc {
  Arc arc;
  double chi_square = 0.0;  ///< sum of the squared distances from the circle over their variances
};

/// The two rays from the origin that touch a pillar which stands free: beside the first of its
/// points and beside the last, counter-clockwise.
struct Limbs {
  Eigen::Vector2d first, last;  ///< unit
  double variance = 0.0;        ///< m^2, > 0, of their distance from the pillar
};

/// The circle from which the points have the least chi-square, by Gauss and Newton from Taubin's
/// algebraic fit [Taubin 1991; Chernov 2010], and the piece of it from the first point to the last.
///
/// @param points  in the order in which they follow one another along the curve.
/// @param first, last  those with first <= i < last are fitted.
/// @param limbs   where given, the circle touches them as well: they are two points more, and the
///                fit starts between them.
/// @return  nothing for too few points (four, two with limbs), and where they lie on a line or on
///          no circle.
/// Cost: O(points).
std::optional<FittedArc> fitArc(const std::vector<CurvePoint>& points, int first, int last,
                                const std::optional<Limbs>& limbs = std::nullopt);

}  // namespace cca
