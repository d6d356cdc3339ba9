// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_extraction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cca {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(ExtractLines, FindsTheSingleWallInView) {
  Scan scan;
  scan.angle_min = -0.5;
  scan.angle_increment = 0.01;
  for (int i = 0; i < 100; ++i) scan.ranges.push_back(2.0 / std::cos(scan.bearing(i)));
  const auto lines = extractLines(scan);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].start.x(), 2.0, 1e-6);
  EXPECT_NEAR(lines[0].end.x(), 2.0, 1e-6);
  EXPECT_NEAR(lines[0].length(), 2.0 * (std::tan(0.5) + std::tan(0.49)), 1e-6);
}

TEST(ExtractLines, GivesNothingForScansWithoutReturns) {
  Scan scan;
  EXPECT_TRUE(extractLines(scan).empty());
  scan.angle_increment = 0.01;
  for (const double range : {kInf, std::nan(""), 0.0, -1.0}) {
    scan.ranges.assign(50, range);
    EXPECT_TRUE(extractLines(scan).empty());
  }
  scan.ranges = {1.0, 1.0};
  EXPECT_TRUE(extractLines(scan).empty());
}

}  // namespace
}  // namespace cca
