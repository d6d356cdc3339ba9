// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/scan_regression.hpp"

#include <algorithm>
#include <cmath>

namespace cca::baselines {
namespace {

/// The cheapest way to cut a run into lines of two points and more.
void cut(const PrefixMoments& moments, Run run, double price, std::vector<Run>& out) {
  const std::size_t n = run.size();
  std::vector<double> cost(n + 1, INFINITY);  // of the first points
  std::vector<std::size_t> begin(n + 1, 0);   // of the last line among them
  cost[0] = 0.0;
  for (std::size_t last = 2; last <= n; ++last) {
    for (std::size_t first = 0; first + 2 <= last; ++first) {
      if (cost[first] + price >= cost[last]) continue;
      const auto line =
          moments.run(static_cast<int>(run.first + first), static_cast<int>(run.first + last));
      const double total = cost[first] + price + principalAxis(line).residual_sum_sq;
      if (total < cost[last]) cost[last] = total, begin[last] = first;
    }
  }
  std::vector<Run> lines;
  for (std::size_t last = n; last >= 2; last = begin[last]) {
    lines.push_back({run.first + begin[last], run.first + last});
  }
  out.insert(out.end(), lines.rbegin(), lines.rend());
}

}  // namespace

ScanRegressionParameters ScanRegressionParameters::tuned() {
  return {{{0.67, 16.0}, {5, 0.31}}, 0.018, 56.0};
}

std::vector<LineSegment> scanRegression(const Scan& scan, const ScanRegressionParameters& p) {
  const Points points = returnedPoints(scan);
  const PrefixMoments moments(points);
  const double price = p.price * p.range_noise * p.range_noise;
  std::vector<Run> runs;
  for (const Run& run : contiguousRuns(points, scan.angle_increment, p.common.break_points)) {
    cut(moments, run, price, runs);
  }
  return segmentsOf(points, runs, p.common.limits);
}

}  // namespace cca::baselines
