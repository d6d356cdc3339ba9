// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cca {

namespace {

constexpr double kMiss = std::numeric_limits<double>::infinity();

double castOnDisc(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double radius) {
  const double along = -from.dot(direction);
  const double gap_sq = from.squaredNorm() - radius * radius;
  if (gap_sq <= 0.0) return 0.0;
  const double discriminant = along * along - gap_sq;
  if (along <= 0.0 || discriminant < 0.0) return kMiss;
  return gap_sq / (along + std::sqrt(discriminant));
}

/// The slab method: the beam is inside the box between the last entry and the first exit.
double castOnBox(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                 const Eigen::Vector2d& half_size) {
  double entry = 0.0, exit = kMiss;
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0.0) {
      if (std::abs(from[axis]) > half_size[axis]) return kMiss;
      continue;
    }
    const double a = (-half_size[axis] - from[axis]) / direction[axis];
    const double b = (half_size[axis] - from[axis]) / direction[axis];
    entry = std::max(entry, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  return entry <= exit ? entry : kMiss;
}

}  // namespace

double distance(const Body& body, const Eigen::Vector2d& p_map) {
  const Eigen::Vector2d p_body = body.T_map_body.inverse() * p_map;
  if (body.shape == Body::Shape::kDisc) return std::max(0.0, p_body.norm() - body.half_size.x());
  return (p_body.cwiseAbs() - body.half_size).cwiseMax(0.0).norm();
}

double castBeam(const Body& body, const Eigen::Vector2d& p_map, double bearing) {
  const Pose2 T_body_map = body.T_map_body.inverse();
  const Eigen::Vector2d from = T_body_map * p_map;
  const double angle = bearing + T_body_map.theta;
  const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
  if (body.shape == Body::Shape::kDisc) return castOnDisc(from, direction, body.half_size.x());
  return castOnBox(from, direction, body.half_size);
}

}  // namespace cca
