// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/split_and_merge.hpp"

#include <algorithm>

#include "geometry/cross.hpp"

namespace cca::baselines {
namespace {

double signedDistance(const FittedLine& line, const Eigen::Vector2d& point) {
  const Eigen::Vector2d offset = point - line.centroid;
  return cross(line.direction, offset);
}

bool twoNeighboursLeave(const Points& points, Run run, double tolerance) {
  const FittedLine line = fitLine(momentsOf(points, run));
  double before = 0.0;
  for (std::size_t i = run.first; i < run.last; ++i) {
    const double here = signedDistance(line, points[i]);
    if (std::min(before, here) > tolerance || std::max(before, here) < -tolerance) return true;
    before = here;
  }
  return false;
}

void split(const Points& points, Run run, double tolerance, std::vector<Run>& out) {
  if (run.size() < 3 || !twoNeighboursLeave(points, run, tolerance)) {
    out.push_back(run);
    return;
  }
  const std::size_t cut = farthestFromChord(points, run);
  split(points, {run.first, cut}, tolerance, out);
  split(points, {cut, run.last}, tolerance, out);
}

}  // namespace

SplitAndMergeParameters SplitAndMergeParameters::tuned() {
  return {{{0.67, 84.0}, {6, 0.14}}, 0.076};
}

std::vector<LineSegment> splitAndMerge(const Scan& scan, const SplitAndMergeParameters& p) {
  const Points points = returnedPoints(scan);
  std::vector<Run> runs;
  for (const Run& run : contiguousRuns(points, scan.angle_increment, p.common.break_points)) {
    split(points, run, p.tolerance, runs);
  }
  runs = mergeCollinear(points, runs, p.tolerance, scan.angle_increment, p.common.break_points);
  return segmentsOf(points, runs, p.common.limits);
}

}  // namespace cca::baselines
