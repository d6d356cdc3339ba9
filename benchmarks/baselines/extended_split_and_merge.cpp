// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/extended_split_and_merge.hpp"

#include <algorithm>
#include <cmath>

namespace cca::baselines {
namespace {

/// Successive Edge Following: cuts where neighbouring ranges differ.
void followEdges(const Points& points, Run run, double edge, std::vector<Run>& out) {
  Run part{run.first, run.first};
  for (std::size_t i = run.first; i < run.last; ++i) {
    if (i > run.first && std::abs(points[i].norm() - points[i - 1].norm()) > edge) {
      out.push_back(part);
      part.first = i;
    }
    part.last = i + 1;
  }
  out.push_back(part);
}

/// Line Tracking: cuts where a point lies beside the line through those before it.
void track(const Points& points, Run run, double distance, std::vector<Run>& out) {
  Run part{run.first, run.first};
  PointMoments moments;
  for (std::size_t i = run.first; i < run.last; ++i) {
    if (part.size() > 2 && distanceFrom(fitLine(moments), points[i]) > distance) {
      out.push_back(part);
      part.first = i;
      moments = PointMoments{};
    }
    moments.add(points[i]);
    part.last = i + 1;
  }
  out.push_back(part);
}

void splitAtFarthest(const Points& points, Run run, double tolerance, std::vector<Run>& out) {
  if (run.size() > 2) {
    const FittedLine line = fitLine(momentsOf(points, run));
    const std::size_t cut = farthestFromChord(points, run);
    if (distanceFrom(line, points[cut]) > tolerance) {
      splitAtFarthest(points, {run.first, cut}, tolerance, out);
      splitAtFarthest(points, {cut, run.last}, tolerance, out);
      return;
    }
  }
  out.push_back(run);
}

template <class Kernel>
std::vector<Run> each(const Points& points, const std::vector<Run>& runs, double threshold,
                      Kernel&& kernel) {
  std::vector<Run> parts;
  for (const Run& run : runs) kernel(points, run, threshold, parts);
  return parts;
}

}  // namespace

ExtendedSplitAndMergeParameters ExtendedSplitAndMergeParameters::tuned() {
  return {{{0.12, 6.4}, {2, 0.56}}, 0.53, 0.058, 0.15};
}

std::vector<LineSegment> extendedSplitAndMerge(const Scan& scan,
                                               const ExtendedSplitAndMergeParameters& p) {
  const Points points = returnedPoints(scan);
  const double spacing = scan.angle_increment;
  std::vector<Run> runs = contiguousRuns(points, spacing, p.common.break_points);
  runs = each(points, runs, p.edge, followEdges);
  runs = each(points, runs, p.tracking, track);
  runs = mergeCollinear(points, runs, p.tolerance, spacing, p.common.break_points);
  runs = each(points, runs, p.tolerance, splitAtFarthest);
  runs = mergeCollinear(points, runs, p.tolerance, spacing, p.common.break_points);
  return segmentsOf(points, runs, p.common.limits);
}

}  // namespace cca::baselines
