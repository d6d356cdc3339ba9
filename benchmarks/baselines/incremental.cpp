// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/incremental.hpp"

#include <cmath>

namespace cca::baselines {
namespace {

void grow(const Points& points, Run run, const IncrementalParameters& p, std::vector<Run>& out) {
  PointMoments moments;
  Run line_run{run.first, run.first};
  for (std::size_t i = run.first; i < run.last; ++i) {
    PointMoments longer = moments;
    longer.add(points[i]);
    const FittedLine line = fitLine(longer);
    const double rms = std::sqrt(line.residual_sum_sq / longer.weight);
    if (rms > p.max_rms || distanceFrom(line, points[i]) > p.tolerance) {
      out.push_back(line_run);
      line_run.first = i;
      longer = PointMoments{};
      longer.add(points[i]);
    }
    line_run.last = i + 1;
    moments = longer;
  }
  out.push_back(line_run);
}

}  // namespace

IncrementalParameters IncrementalParameters::tuned() {
  return {{{0.12, 6.4}, {2, 0.56}}, 0.094, 0.024};
}

std::vector<LineSegment> incremental(const Scan& scan, const IncrementalParameters& p) {
  const Points points = returnedPoints(scan);
  std::vector<Run> runs;
  for (const Run& run : contiguousRuns(points, scan.angle_increment, p.common.break_points)) {
    grow(points, run, p, runs);
  }
  runs = mergeCollinear(points, runs, p.tolerance, scan.angle_increment, p.common.break_points);
  return segmentsOf(points, runs, p.common.limits);
}

}  // namespace cca::baselines
