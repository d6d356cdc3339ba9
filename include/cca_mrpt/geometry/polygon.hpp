// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace cca {

using Polygon = std::vector<Eigen::Vector2d>;  ///< m, corners in their order, simple

inline Eigen::AlignedBox2d boundsOf(const Polygon& polygon) {
  Eigen::AlignedBox2d bounds;
  for (const auto& corner : polygon) bounds.extend(corner);
  return bounds;
}

/// Even-odd rule; on the edge itself either answer; nothing is inside of no corners.
/// Cost: O(corners).
inline bool isInside(const Polygon& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

}  // namespace cca
