// SPDX-License-Identifier: BSD-3-Clause
// Example 1: the lines of one scan. Needs Eigen only: link cca_mrpt::mapping.
#include <cmath>
#include <cstdio>

#include "cca_mrpt/mapping/line_extraction.hpp"

int main() {
  // A laser of 181 beams, 1 degree apart, in the middle of a room of 6 m x 4 m.
  cca::Scan scan;
  scan.angle_min = -0.5 * M_PI;
  scan.angle_increment = M_PI / 180.0;
  for (std::size_t beam = 0; beam <= 180; ++beam) {
    const double c = std::cos(scan.bearing(beam)), s = std::abs(std::sin(scan.bearing(beam)));
    const double to_front = c > 1e-9 ? 3.0 / c : HUGE_VAL;
    const double to_side = s > 1e-9 ? 2.0 / s : HUGE_VAL;
    scan.ranges.push_back(std::min(to_front, to_side));
  }

  for (const cca::LineSegment& line : cca::extractLines(scan)) {
    std::printf("(%.2f, %.2f) to (%.2f, %.2f): %.2f m, offset +- %.1f mm, from %.0f points\n",
                line.start.x(), line.start.y(), line.end.x(), line.end.y(), line.length(),
                1e3 * std::sqrt(line.covariance(0, 0)), line.moments.weight);
  }
}
