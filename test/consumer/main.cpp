// SPDX-License-Identifier: BSD-3-Clause
#include <cca_mrpt/mapping/line_extraction.hpp>
#include <cca_mrpt/slam/slam.hpp>
#include <cmath>
#include <cstdio>

/// Ends with success when a wall 2 m ahead comes back as one line, and as a key frame.
int main() {
  cca::Scan scan;
  scan.angle_min = -0.5;
  scan.angle_increment = 0.01;
  for (int i = 0; i <= 100; ++i) scan.ranges.push_back(2.0 / std::cos(scan.bearing(i)));
  const auto lines = cca::extractLines(scan);
  std::printf("%zu line(s)\n", lines.size());
  cca::Slam slam;
  slam.step(scan, {}, {});
  return lines.size() == 1 && std::abs(lines[0].start.x() - 2.0) < 0.01 && slam.graph().size() == 1
             ? 0
             : 1;
}
