// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/convolution_clustering.hpp"

#include <algorithm>
#include <cmath>

namespace cca::baselines {
namespace {

std::vector<Run> clusters(const Points& points, const ConvolutionClusteringParameters& p) {
  std::vector<Run> found;
  const auto n = static_cast<std::ptrdiff_t>(points.size());
  const auto step = [&](std::ptrdiff_t i) {
    return (points[static_cast<std::size_t>(i) + 1] - points[static_cast<std::size_t>(i)]).norm();
  };
  std::size_t first = 0;
  for (std::ptrdiff_t i = 0; i + 1 < n; ++i) {
    std::vector<double> neighbours;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - p.half_width);
         k <= std::min<std::ptrdiff_t>(n - 2, i + p.half_width); ++k) {
      if (k != i) neighbours.push_back(step(k));
    }
    double mean = 0.0;
    for (double d : neighbours) mean += d / static_cast<double>(neighbours.size());
    if (step(i) - mean <= p.threshold) continue;
    found.push_back({first, static_cast<std::size_t>(i) + 1});
    first = static_cast<std::size_t>(i) + 1;
  }
  if (first < points.size()) found.push_back({first, points.size()});
  return found;
}

FittedLine strongestLine(const Points& points, Run run, const HoughResolution& resolution) {
  // Votes are taken about the cluster's centroid, so that the accumulator is no larger than it.
  const Eigen::Vector2d centre = momentsOf(points, run).mean;
  double reach = resolution.distance;
  for (std::size_t i = run.first; i < run.last; ++i) {
    reach = std::max(reach, (points[i] - centre).norm());
  }
  HoughAccumulator accumulator(resolution, reach);
  for (std::size_t i = run.first; i < run.last; ++i) accumulator.vote(points[i] - centre, 1);
  FittedLine line = accumulator.strongest().line;
  line.centroid += centre;
  return line;
}

/// The longest stretch of the run that follows the line, but for a few points in a row.
Run follow(const Points& points, Run run, const FittedLine& line, double distance, int misses) {
  Run best{run.first, run.first}, now{run.first, run.first};
  int missed = misses + 1;
  for (std::size_t i = run.first; i < run.last; ++i) {
    if (distanceFrom(line, points[i]) > distance) {
      ++missed;
      continue;
    }
    if (missed > misses) now.first = i;
    missed = 0;
    now.last = i + 1;
    if (now.size() > best.size()) best = now;
  }
  return best;
}

Points near(const Points& points, Run run, const FittedLine& line, double distance) {
  Points members;
  for (std::size_t i = run.first; i < run.last; ++i) {
    if (distanceFrom(line, points[i]) <= distance) members.push_back(points[i]);
  }
  return members;
}

void extract(const Points& points, Run run, const ConvolutionClusteringParameters& p,
             std::vector<LineSegment>& out) {
  if (run.size() < static_cast<std::size_t>(std::max(2, p.limits.min_points))) return;
  FittedLine line = strongestLine(points, run, p.resolution);
  Run tracked = follow(points, run, line, p.distance, p.max_misses);
  if (tracked.size() < 2) return;
  const Points first_members = near(points, tracked, line, p.distance);
  line = fitLine(momentsOf(first_members, {0, first_members.size()}));
  tracked = follow(points, run, line, p.distance, p.max_misses);
  if (tracked.size() < 2 || tracked.size() < static_cast<std::size_t>(p.limits.min_points)) return;
  extract(points, {run.first, tracked.first}, p, out);
  const Points members = near(points, tracked, line, p.distance);
  if (members.size() >= 2) {
    const LineSegment segment = segmentThrough(members);
    if (isLongEnough(segment, members.size(), p.limits)) out.push_back(segment);
  }
  extract(points, {tracked.last, run.last}, p, out);
}

}  // namespace

ConvolutionClusteringParameters ConvolutionClusteringParameters::tuned() {
  return {4, 0.2, {0.54, 0.011}, 0.066, 8, {4, 0.45}};
}

std::vector<LineSegment> convolutionClustering(const Scan& scan,
                                               const ConvolutionClusteringParameters& p) {
  const Points points = returnedPoints(scan);
  std::vector<LineSegment> segments;
  for (const Run& run : clusters(points, p)) extract(points, run, p, segments);
  return segments;
}

}  // namespace cca::baselines
