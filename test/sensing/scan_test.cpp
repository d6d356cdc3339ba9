// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/scan.hpp"

#include <gtest/gtest.h>

#include "polygon_room.hpp"

namespace cca::scan_test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(ScanPoints, LieAtRangeAndBearing) {
  Scan scan;
  scan.angle_min = -1.0;
  scan.angle_increment = 0.01;
  for (int i = 0; i < 200; ++i) scan.ranges.push_back(1.0 + 0.01 * i);
  const ScanPoints points = scanPoints(scan);
  ASSERT_EQ(points.size(), 200u);
  for (std::size_t i = 0; i < 200; ++i) {
    const Eigen::Vector2d truth(scan.ranges[i] * std::cos(scan.bearing(i)),
                                scan.ranges[i] * std::sin(scan.bearing(i)));
    EXPECT_NEAR((points.positions[i] - truth).norm(), 0.0, 1e-12);
  }
  EXPECT_FALSE(points.closed);
}

TEST(ScanPoints, LeaveOutWhatIsNoReturnAndCountTheSilentBeams) {
  Scan scan;
  scan.angle_increment = 0.01;
  scan.ranges = {1.0, kInf, std::nan(""), -1.0, 0.0, 1e9, 1.0, -kInf, kInf, kInf, 1.0};
  const ScanPoints points = scanPoints(scan);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points.silentBetween(0, 1), 1);
  EXPECT_EQ(points.silentBetween(1, 2), 2);
  EXPECT_EQ(points.beams[1], 6);
}

TEST(ScanPoints, TurnClockwiseScansRound) {
  std::mt19937 random(1);
  const PolygonRoom room = rectangle(-2.0, -1.0, 3.0, 2.0);
  const Scan scan = scanOf(room, -1.0, 0.01, 150, 0.01, &random);
  Scan clockwise = scan;
  std::reverse(clockwise.ranges.begin(), clockwise.ranges.end());
  clockwise.angle_min = scan.bearing(149);
  clockwise.angle_increment = -0.01;
  const ScanPoints a = scanPoints(scan), b = scanPoints(clockwise);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR((a.positions[i] - b.positions[i]).norm(), 0.0, 1e-12);
  }
}

TEST(ScanPoints, OpenAFullTurnAtACornerNotInsideAWall) {
  std::mt19937 random(1);
  const Scan scan = turnIn(rectangle(-2.0, -1.0, 3.0, 2.0), 0.0, &random);
  const ScanPoints points = scanPoints(scan);
  EXPECT_TRUE(points.closed);
  const Eigen::Vector2d p = points.positions.front();
  double nearest = kInf;
  for (const Eigen::Vector2d& corner : rectangle(-2.0, -1.0, 3.0, 2.0).vertices) {
    nearest = std::min(nearest, (corner - p).norm());
  }
  EXPECT_LT(nearest, 0.1);
}

TEST(ScanPoints, CountStepsInDepthButNotGrazingWalls) {
  Scan step;
  step.angle_increment = 0.01;
  step.ranges = {1.0, 1.0, 1.0, 2.0, 2.0, 2.0};
  const ScanPoints points = scanPoints(step);
  EXPECT_EQ(points.breaksBetween(0, 2), 0);
  EXPECT_EQ(points.breaksBetween(2, 3), 1);
  EXPECT_EQ(points.breaksBetween(3, 5), 0);
  Scan corridor;  // a wall at y = 1, seen down to 10 degrees
  corridor.angle_min = 10.0 * M_PI / 180.0;
  corridor.angle_increment = 0.5 * M_PI / 180.0;
  for (std::size_t i = 0; i < 160; ++i) {
    corridor.ranges.push_back(1.0 / std::sin(corridor.bearing(i)));
  }
  const ScanPoints wall = scanPoints(corridor);
  EXPECT_EQ(wall.breaksBetween(0, 159), 0);
}

TEST(ScanPoints, ReopenedKeepTheirPointsAndTheirSilence) {
  Scan scan;
  scan.angle_min = -M_PI;
  scan.angle_increment = 2.0 * M_PI / 100.0;
  for (int i = 0; i < 100; ++i) scan.ranges.push_back(i % 10 == 3 ? kInf : 2.0 + 0.01 * i);
  const ScanPoints before = scanPoints(scan);
  ScanPoints after = before;
  const int n = static_cast<int>(before.size()), shift = 37;
  reopen(shift, &after);
  for (int i = 0; i < n; ++i) {
    EXPECT_EQ(after.positions[i], before.positions[(i + shift) % n]);
    if (i > 0) {
      EXPECT_GT(after.beams[i], after.beams[i - 1]);
    }
  }
  EXPECT_EQ(after.silentBetween(0, n - 1) + after.silentAtSeam(), 10);
  EXPECT_EQ(before.silentBetween(0, n - 1) + before.silentAtSeam(), 10);
  for (int i = 1; i < n; ++i) {
    const int gap = after.beams[i] - after.beams[i - 1] - 1;
    EXPECT_EQ(after.silentBetween(i - 1, i), gap);
  }
}

TEST(ScanPoints, ReopenedKeepTheirStepsInDepth) {
  Scan scan;
  scan.angle_min = -M_PI;
  scan.angle_increment = 2.0 * M_PI / 100.0;
  for (int i = 0; i < 100; ++i) scan.ranges.push_back(i % 25 == 7 ? kInf : i < 50 ? 2.0 : 4.0);
  const ScanPoints before = scanPoints(scan);
  const int n = static_cast<int>(before.size());
  EXPECT_EQ(before.breaksBetween(0, n - 1), 3 + 2);
  for (int first = 1; first < n; ++first) {
    ScanPoints points = before;
    reopen(first, &points);
    for (int i = 1; i < n - first; ++i) {
      EXPECT_EQ(points.breaksBetween(i - 1, i), before.breaksBetween(i + first - 1, i + first));
    }
    reopen(n - first, &points);
    EXPECT_EQ(points.beams, before.beams);
    for (int i = 0; i < n; ++i) {
      EXPECT_EQ(points.breaksBetween(0, i), before.breaksBetween(0, i));
      EXPECT_EQ(points.silentBetween(0, i), before.silentBetween(0, i));
    }
  }
}

TEST(ScanPoints, AreEmptyForScansThatCannotBeRead) {
  Scan scan;
  EXPECT_EQ(scanPoints(scan).size(), 0u);
  scan.ranges = {1.0, 1.0, 1.0};
  for (const double increment : {0.0, std::nan(""), kInf}) {
    scan.angle_increment = increment;
    EXPECT_EQ(scanPoints(scan).size(), 0u);
  }
}

}  // namespace
}  // namespace cca::scan_test
