// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/weighted_line_fitting.hpp"

#include <algorithm>
#include <cmath>

#include "baselines/hough_transform.hpp"
#include "geometry/cross.hpp"

namespace cca::baselines {
namespace {

constexpr int kRefits = 4;  // the weights change little after the second

/// Variance of a point across a line: its range noise and bearing noise seen along the normal.
double varianceAcross(const Eigen::Vector2d& point, const Eigen::Vector2d& direction,
                      const WeightedLineFittingParameters& p) {
  const Eigen::Vector2d normal(-direction.y(), direction.x());
  const double range = point.norm();
  const Eigen::Vector2d radial = point / range, tangential(-radial.y(), radial.x());
  const double by_range = p.range_noise * normal.dot(radial);
  const double by_bearing = p.bearing_noise_deg * M_PI / 180.0 * range * normal.dot(tangential);
  return by_range * by_range + by_bearing * by_bearing;
}

PointMoments weightedMoments(const Points& points, const FittedLine& line,
                             const WeightedLineFittingParameters& p) {
  PointMoments moments;
  for (const auto& point : points) {
    moments.add(point, 1.0 / varianceAcross(point, line.direction, p));
  }
  return moments;
}

/// The segment of the points, its line fitted by weights, its covariance from the weights.
LineSegment fitWeighted(const Points& points, const WeightedLineFittingParameters& p) {
  LineSegment segment = segmentThrough(points);
  FittedLine line = fitLine(segment.moments);
  for (int refit = 0; refit < kRefits; ++refit) line = fitLine(weightedMoments(points, line, p));
  segment.moments = weightedMoments(points, line, p);
  const auto onto = [&](const Eigen::Vector2d& end) {
    return Eigen::Vector2d(line.centroid +
                           line.direction.dot(end - line.centroid) * line.direction);
  };
  segment.start = onto(segment.start);
  segment.end = onto(segment.end);
  segment.covariance = Eigen::Matrix2d::Zero();
  segment.covariance(0, 0) = 1.0 / segment.moments.weight;
  if (line.spread_sum_sq > 0.0) segment.covariance(1, 1) = 1.0 / line.spread_sum_sq;
  return segment;
}

/// Squared Mahalanobis distance of two segments' lines, compared at a's centroid.
double chiSquare(const LineSegment& a, const LineSegment& b) {
  const Eigen::Vector2d u = a.direction(), v = b.direction();
  const double turn = std::asin(std::clamp(cross(u, v), -1.0, 1.0)) * (u.dot(v) < 0.0 ? -1.0 : 1.0);
  const Eigen::Vector2d arm = a.moments.mean - b.moments.mean;
  const double offset = cross(v, arm);
  const double reach = v.dot(arm);
  const double lateral =
      a.covariance(0, 0) + b.covariance(0, 0) + reach * reach * b.covariance(1, 1);
  return offset * offset / lateral + turn * turn / (a.covariance(1, 1) + b.covariance(1, 1));
}

/// Gap between two segments along a; negative where they overlap.
double gapAlong(const LineSegment& a, const LineSegment& b) {
  const Eigen::Vector2d u = a.direction();
  const double p = u.dot(b.start - a.start), q = u.dot(b.end - a.start);
  return std::max(std::min(p, q) - a.length(), -std::max(p, q));
}

/// The maximum-likelihood joint line: the sum of the weighted statistics.
LineSegment join(const LineSegment& a, const LineSegment& b) {
  LineSegment joint;
  joint.moments = a.moments;
  joint.moments.add(b.moments);
  const FittedLine line = fitLine(joint.moments);
  double low = 0.0, high = 0.0;
  for (const auto& end : {a.start, a.end, b.start, b.end}) {
    const double along = line.direction.dot(end - line.centroid);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  joint.start = line.centroid + low * line.direction;
  joint.end = line.centroid + high * line.direction;
  joint.covariance(0, 0) = 1.0 / joint.moments.weight;
  if (line.spread_sum_sq > 0.0) joint.covariance(1, 1) = 1.0 / line.spread_sum_sq;
  return joint;
}

void mergeAlike(std::vector<LineSegment>& segments, const WeightedLineFittingParameters& p) {
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (std::size_t j = i + 1; j < segments.size(); ++j) {
      if (gapAlong(segments[i], segments[j]) > p.inliers.max_gap) continue;
      if (chiSquare(segments[i], segments[j]) > p.chi_square) continue;
      segments[i] = join(segments[i], segments[j]);
      segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(j));
      j = i;  // the longer segment is compared with all others anew
    }
  }
}

}  // namespace

WeightedLineFittingParameters WeightedLineFittingParameters::tuned() {
  return {{3.7, 0.10}, {0.134, 0.78, {4, 0.21}}, 0.0126, 0.157, 3.3};
}

std::vector<LineSegment> weightedLineFitting(const Scan& scan,
                                             const WeightedLineFittingParameters& p) {
  std::vector<LineSegment> segments;
  for (const auto& group : houghPieces(returnedPoints(scan), {p.grouping, p.inliers})) {
    segments.push_back(fitWeighted(group, p));
  }
  mergeAlike(segments, p);
  sortByBearing(segments);
  return segments;
}

}  // namespace cca::baselines
