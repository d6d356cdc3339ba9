// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/point_runs.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cross.hpp"

namespace cca::baselines {
namespace {

bool isBreak(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double beam_spacing,
             const BreakPoints& rule) {
  const double spacing = std::abs(beam_spacing);
  const double grazing = std::max(rule.grazing_deg * M_PI / 180.0, 1.5 * spacing);
  const double explained =
      std::min(a.norm(), b.norm()) * std::sin(spacing) / std::sin(grazing - spacing);
  return (b - a).norm() > rule.max_gap + explained;
}

bool staysWithin(const Points& points, Run run, double tolerance) {
  const FittedLine line = fitLine(momentsOf(points, run));
  for (std::size_t i = run.first; i < run.last; ++i) {
    if (distanceFrom(line, points[i]) > tolerance) return false;
  }
  return true;
}

}  // namespace

Points returnedPoints(const Scan& scan) {
  Points points;
  points.reserve(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!isReturn(scan.ranges[i])) continue;
    const double bearing = scan.bearing(i);
    points.emplace_back(scan.ranges[i] * std::cos(bearing), scan.ranges[i] * std::sin(bearing));
  }
  return points;
}

std::vector<Run> contiguousRuns(const Points& points, double beam_spacing,
                                const BreakPoints& rule) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || isBreak(points[i - 1], points[i], beam_spacing, rule)) runs.push_back({i, i});
    runs.back().last = i + 1;
  }
  return runs;
}

PointMoments momentsOf(const Points& points, Run run) {
  PointMoments moments;
  for (std::size_t i = run.first; i < run.last; ++i) {
    moments.weight += 1.0;
    moments.mean += points[i];
  }
  if (moments.weight > 0.0) moments.mean /= moments.weight;
  for (std::size_t i = run.first; i < run.last; ++i) {
    const Eigen::Vector2d offset = points[i] - moments.mean;
    moments.scatter += offset * offset.transpose();
  }
  return moments;
}

double distanceFrom(const FittedLine& line, const Eigen::Vector2d& point) {
  const Eigen::Vector2d offset = point - line.centroid;
  return std::abs(cross(line.direction, offset));
}

std::size_t farthestFromChord(const Points& points, Run run) {
  const Eigen::Vector2d origin = points[run.first];
  const Eigen::Vector2d chord = points[run.last - 1] - origin;
  const double length = chord.norm();
  std::size_t farthest = run.first + 1;
  double largest = -1.0;
  for (std::size_t i = run.first + 1; i + 1 < run.last; ++i) {
    const Eigen::Vector2d offset = points[i] - origin;
    const double across = std::abs(cross(chord, offset));
    const double distance = length > 0.0 ? across / length : offset.norm();
    if (distance > largest) largest = distance, farthest = i;
  }
  return farthest;
}

LineSegment segmentThrough(const Points& points, Run run) {
  LineSegment segment;
  segment.moments = momentsOf(points, run);
  const FittedLine line = fitLine(segment.moments);
  double low = 0.0, high = 0.0;
  for (std::size_t i = run.first; i < run.last; ++i) {
    const double along = line.direction.dot(points[i] - line.centroid);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  segment.start = line.centroid + low * line.direction;
  segment.end = line.centroid + high * line.direction;
  const double n = segment.moments.weight;
  if (n > 2.0 && line.spread_sum_sq > 0.0) {
    const double variance = line.residual_sum_sq / (n - 2.0);
    segment.covariance(0, 0) = variance / n;
    segment.covariance(1, 1) = variance / line.spread_sum_sq;
  }
  return segment;
}

LineSegment segmentThrough(const Points& points) {
  return segmentThrough(points, {0, points.size()});
}

bool isLongEnough(const LineSegment& segment, std::size_t points, const SegmentLimits& limits) {
  return points >= static_cast<std::size_t>(limits.min_points) && segment.length() > 0.0 &&
         segment.length() >= limits.min_length;
}

std::vector<Run> mergeCollinear(const Points& points, const std::vector<Run>& runs,
                                double tolerance, double beam_spacing, const BreakPoints& rule) {
  std::vector<Run> merged;
  for (const Run& run : runs) {
    const bool follows = !merged.empty() && merged.back().last == run.first &&
                         !isBreak(points[run.first - 1], points[run.first], beam_spacing, rule);
    if (follows && staysWithin(points, {merged.back().first, run.last}, tolerance)) {
      merged.back().last = run.last;
    } else {
      merged.push_back(run);
    }
  }
  return merged;
}

std::vector<LineSegment> segmentsOf(const Points& points, const std::vector<Run>& runs,
                                    const SegmentLimits& limits) {
  std::vector<LineSegment> segments;
  for (const Run& run : runs) {
    if (run.size() < 2) continue;
    const LineSegment segment = segmentThrough(points, run);
    if (isLongEnough(segment, run.size(), limits)) segments.push_back(segment);
  }
  return segments;
}

}  // namespace cca::baselines
