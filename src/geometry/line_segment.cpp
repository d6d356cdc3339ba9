// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/geometry/line_segment.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cross.hpp"

namespace cca {

Eigen::Vector2d LineSegment::direction() const {
  const Eigen::Vector2d along = end - start;
  const double norm = along.norm();
  if (norm <= 0.0) return {1.0, 0.0};
  return along / norm;
}

std::optional<Eigen::Vector2d> intersection(const FittedLine& a, const FittedLine& b) {
  constexpr double kLeastSine = 0.05;  // 3 degrees: lines closer to parallel meet anywhere
  const double sine = cross(a.direction, b.direction);
  if (std::abs(sine) < kLeastSine) return std::nullopt;
  const Eigen::Vector2d between = b.centroid - a.centroid;
  return a.centroid + a.direction * (cross(between, b.direction) / sine);
}

PrefixMoments::PrefixMoments(const std::vector<Eigen::Vector2d>& points,
                             const std::vector<double>& weights)
    : sums_(points.size() + 1) {
  for (const Eigen::Vector2d& p : points) origin_ += p;
  if (!points.empty()) origin_ /= static_cast<double>(points.size());
  PointSums sums;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].x() - origin_.x(), y = points[i].y() - origin_.y();
    sums.addPoint(x, y, weights.empty() ? 1.0 : weights[i]);
    sums_[i + 1] = sums;
  }
}

}  // namespace cca
