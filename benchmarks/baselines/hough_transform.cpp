// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hough_transform.hpp"

#include <algorithm>

namespace cca::baselines {

HoughTransformParameters HoughTransformParameters::tuned() {
  return {{0.54, 0.011}, {0.066, 0.99, {4, 0.45}}};
}

std::vector<Points> houghPieces(const Points& points, const HoughTransformParameters& p) {
  Pool pool(points);
  double reach = p.resolution.distance;
  for (const auto& point : pool.points) reach = std::max(reach, point.norm());
  HoughAccumulator accumulator(p.resolution, reach);
  for (const auto& point : pool.points) accumulator.vote(point, 1);

  std::vector<Points> pieces;
  for (auto peak = accumulator.strongest(); peak.votes >= p.inliers.limits.min_points;
       peak = accumulator.strongest()) {
    const std::vector<bool> before = pool.taken;
    const auto found = takePieces(pool, peak.line, p.inliers);
    pieces.insert(pieces.end(), found.begin(), found.end());
    for (std::size_t i = 0; i < pool.points.size(); ++i) {
      // A cell whose points make no segment is silenced, or it would stay the strongest for ever.
      const bool silenced = found.empty() && !pool.taken[i] &&
                            distanceFrom(peak.line, pool.points[i]) <= p.resolution.distance;
      if (silenced) pool.taken[i] = true;
      if (pool.taken[i] && !before[i]) accumulator.vote(pool.points[i], -1);
    }
    if (pool.taken == before) break;
  }
  return pieces;
}

std::vector<LineSegment> houghTransform(const Scan& scan, const HoughTransformParameters& p) {
  return segmentsOf(houghPieces(returnedPoints(scan), p));
}

}  // namespace cca::baselines
