// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/seeded_region_growing.hpp"

#include <algorithm>
#include <cmath>

namespace cca::baselines {
namespace {

/// Near the line, and near where the point's own beam meets the line.
bool agrees(const FittedLine& line, const Eigen::Vector2d& point,
            const SeededRegionGrowingParameters& p) {
  if (distanceFrom(line, point) > p.distance) return false;
  const Eigen::Vector2d normal(-line.direction.y(), line.direction.x());
  const double range = point.norm();
  const double facing = normal.dot(point) / range;
  if (facing == 0.0) return false;
  return std::abs(normal.dot(line.centroid) / facing - range) <= p.predicted_distance;
}

bool isSeed(const Points& points, Run run, const SeededRegionGrowingParameters& p) {
  const FittedLine line = fitLine(momentsOf(points, run));
  for (std::size_t i = run.first; i < run.last; ++i) {
    if (!agrees(line, points[i], p)) return false;
  }
  return true;
}

/// Grows forwards to the end of the points, backwards no farther than `lowest`.
Run grow(const Points& points, Run run, std::size_t lowest,
         const SeededRegionGrowingParameters& p) {
  PointMoments moments = momentsOf(points, run);
  while (run.last < points.size() && agrees(fitLine(moments), points[run.last], p)) {
    moments.add(points[run.last++]);
  }
  while (run.first > lowest && agrees(fitLine(moments), points[run.first - 1], p)) {
    moments.add(points[--run.first]);
  }
  return run;
}

/// Points that two neighbours claim: those before the cut are nearer to the former's line.
void settleOverlap(const Points& points, Run& former, Run& latter) {
  if (latter.first >= former.last) return;
  const FittedLine a = fitLine(momentsOf(points, former)), b = fitLine(momentsOf(points, latter));
  std::size_t cut = std::max(latter.first, former.first);
  while (cut < std::min(former.last, latter.last) &&
         distanceFrom(a, points[cut]) <= distanceFrom(b, points[cut])) {
    ++cut;
  }
  former.last = latter.first = cut;
}

}  // namespace

SeededRegionGrowingParameters SeededRegionGrowingParameters::tuned() {
  return {0.147, 0.19, 3, {4, 0.13}};
}

std::vector<LineSegment> seededRegionGrowing(const Scan& scan,
                                             const SeededRegionGrowingParameters& p) {
  const Points points = returnedPoints(scan);
  const auto width = static_cast<std::size_t>(p.seed_points);
  std::vector<Run> runs;
  for (std::size_t i = 0; i + width <= points.size();) {
    if (!isSeed(points, {i, i + width}, p)) {
      ++i;
      continue;
    }
    const Run grown = grow(points, {i, i + width}, runs.empty() ? 0 : runs.back().first + 1, p);
    i = grown.last;
    const bool enough = grown.size() >= static_cast<std::size_t>(p.limits.min_points);
    if (enough && segmentThrough(points, grown).length() >= p.limits.min_length) {
      runs.push_back(grown);
    }
  }
  for (std::size_t k = 1; k < runs.size(); ++k) settleOverlap(points, runs[k - 1], runs[k]);
  return segmentsOf(points, runs, p.limits);
}

}  // namespace cca::baselines
