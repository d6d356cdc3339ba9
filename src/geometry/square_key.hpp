// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace cca {

/// A number for the square of the plane that holds a point, for tables by hash; any finite point.
/// @param side  m, of the squares.
inline std::int64_t squareKey(const Eigen::Vector2d& p, double side) {
  const auto x = static_cast<std::int64_t>(std::floor(p.x() / side));
  const auto y = static_cast<std::int64_t>(std::floor(p.y() / side));
  return x * (std::int64_t{1} << 32) + y;
}

/// The point in the k-th of nine squares around that of p, k in [0, 9).
inline Eigen::Vector2d inSquareAround(const Eigen::Vector2d& p, int k, double side) {
  return p + side * Eigen::Vector2d(k % 3 - 1, k / 3 - 1);
}

}  // namespace cca
