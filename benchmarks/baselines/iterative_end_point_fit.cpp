// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/iterative_end_point_fit.hpp"

#include <cmath>

#include "geometry/cross.hpp"

namespace cca::baselines {
namespace {

double distanceFromChord(const Points& points, Run run, std::size_t i) {
  const Eigen::Vector2d chord = points[run.last - 1] - points[run.first];
  const Eigen::Vector2d offset = points[i] - points[run.first];
  const double length = chord.norm();
  if (length <= 0.0) return offset.norm();
  return std::abs(cross(chord, offset)) / length;
}

void split(const Points& points, Run run, const IterativeEndPointFitParameters& p,
           std::vector<LineSegment>& out) {
  if (run.size() < 2) return;
  if (run.size() > 2) {
    const std::size_t cut = farthestFromChord(points, run);
    if (distanceFromChord(points, run, cut) > p.tolerance) {
      split(points, {run.first, cut + 1}, p, out);
      split(points, {cut, run.last}, p, out);
      return;
    }
  }
  LineSegment segment = segmentThrough(points, run);
  segment.start = points[run.first];
  segment.end = points[run.last - 1];
  if (isLongEnough(segment, run.size(), p.common.limits)) out.push_back(segment);
}

}  // namespace

IterativeEndPointFitParameters IterativeEndPointFitParameters::tuned() {
  return {{{0.46, 11.5}, {7, 0.08}}, 0.146};
}

std::vector<LineSegment> iterativeEndPointFit(const Scan& scan,
                                              const IterativeEndPointFitParameters& p) {
  const Points points = returnedPoints(scan);
  std::vector<LineSegment> segments;
  for (const Run& run : contiguousRuns(points, scan.angle_increment, p.common.break_points)) {
    split(points, run, p, segments);
  }
  return segments;
}

}  // namespace cca::baselines
