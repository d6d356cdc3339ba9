// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/line_regression.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cross.hpp"

namespace cca::baselines {
namespace {

double lineAngle(const FittedLine& a, const FittedLine& b) {
  return std::asin(std::min(1.0, std::abs(cross(a.direction, b.direction))));
}

/// Squared Mahalanobis distance of two lines in (lateral offset, orientation), compared midway
/// between their centroids. Infinite where a run has no extent.
double lineDistance(const PointMoments& a, const PointMoments& b, double noise) {
  const FittedLine line_a = fitLine(a), line_b = fitLine(b);
  if (line_a.spread_sum_sq <= 0.0 || line_b.spread_sum_sq <= 0.0) return INFINITY;
  const Eigen::Vector2d midway = 0.5 * (a.mean + b.mean);
  const double variance = noise * noise;
  const double turn_a = variance / line_a.spread_sum_sq, turn_b = variance / line_b.spread_sum_sq;
  const double arm_sq = 0.25 * (a.mean - b.mean).squaredNorm();
  const double lateral_variance =
      variance / a.weight + variance / b.weight + arm_sq * (turn_a + turn_b);
  // Both distances are taken from midway, each to its own line: their difference is the offset.
  const Eigen::Vector2d normal(-line_a.direction.y(), line_a.direction.x());
  const Eigen::Vector2d normal_b_raw(-line_b.direction.y(), line_b.direction.x());
  const Eigen::Vector2d normal_b =
      normal.dot(normal_b_raw) < 0.0 ? Eigen::Vector2d(-normal_b_raw) : normal_b_raw;
  const double offset =
      normal.dot(line_a.centroid - midway) - normal_b.dot(line_b.centroid - midway);
  const double turn = lineAngle(line_a, line_b);
  return offset * offset / lateral_variance + turn * turn / (turn_a + turn_b);
}

/// Maximal stretches of windows that agree, as runs of points that do not overlap.
std::vector<Run> stretches(const Points& points, Run run, const LineRegressionParameters& p) {
  const std::size_t width = static_cast<std::size_t>(p.window);
  std::vector<Run> found;
  if (run.size() < width) return {run};
  std::vector<PointMoments> windows;
  for (std::size_t i = run.first; i + width <= run.last; ++i) {
    windows.push_back(momentsOf(points, {i, i + width}));
  }
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const bool agrees =
        i == 0 || lineDistance(windows[i - 1], windows[i], p.range_noise) <= p.largest_fidelity;
    if (!agrees || found.empty()) found.push_back({run.first + i, 0});
    found.back().last = run.first + i + width;
  }
  for (std::size_t k = 1; k < found.size(); ++k) {
    if (found[k].first >= found[k - 1].last) continue;
    const std::size_t middle = (found[k].first + found[k - 1].last) / 2;
    found[k].first = found[k - 1].last = middle;
  }
  return found;
}

void joinLike(const Points& points, std::vector<Run>& runs, const LineRegressionParameters& p) {
  std::vector<PointMoments> moments;
  for (const Run& run : runs) moments.push_back(momentsOf(points, run));
  while (runs.size() > 1) {
    std::size_t best = 0;
    double smallest = INFINITY;
    for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
      const double distance = lineDistance(moments[k], moments[k + 1], p.range_noise);
      if (distance < smallest) smallest = distance, best = k;
    }
    if (smallest > p.merge_distance) return;
    runs[best].last = runs[best + 1].last;
    moments[best].add(moments[best + 1]);
    runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(best) + 1);
    moments.erase(moments.begin() + static_cast<std::ptrdiff_t>(best) + 1);
  }
}

}  // namespace

LineRegressionParameters LineRegressionParameters::tuned() {
  return {{{0.145, 17.0}, {8, 0.18}}, 3, 0.042, 0.57, 10.9};
}

std::vector<LineSegment> lineRegression(const Scan& scan, const LineRegressionParameters& p) {
  const Points points = returnedPoints(scan);
  std::vector<LineSegment> segments;
  for (const Run& run : contiguousRuns(points, scan.angle_increment, p.common.break_points)) {
    std::vector<Run> runs = stretches(points, run, p);
    runs.erase(
        std::remove_if(runs.begin(), runs.end(), [](const Run& r) { return r.last < r.first + 2; }),
        runs.end());
    joinLike(points, runs, p);
    for (const LineSegment& segment : segmentsOf(points, runs, p.common.limits)) {
      segments.push_back(segment);
    }
  }
  return segments;
}

}  // namespace cca::baselines
