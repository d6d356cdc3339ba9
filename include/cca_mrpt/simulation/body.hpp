// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// A solid disc or box that stands in the world but not in its grid.
struct Body {
  enum class Shape { kDisc, kBox };
  Shape shape = Shape::kDisc;
  Eigen::Vector2d half_size{0.25, 0.25};  ///< m; a disc's radius is half_size.x()
  Pose2 T_map_body;

  /// m, of the smallest circle around it.
  double radius() const { return shape == Shape::kDisc ? half_size.x() : half_size.norm(); }
};

/// m, distance from a point to the body, 0 inside.
double distance(const Body& body, const Eigen::Vector2d& p_map);

/// m, distance along a beam (bearing in rad, map frame) to the body's surface; +inf where it
/// misses; 0 from inside.
double castBeam(const Body& body, const Eigen::Vector2d& p_map, double bearing);

}  // namespace cca
