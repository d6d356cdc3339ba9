// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/point_clusters.hpp"

#include <gtest/gtest.h>

#include "../sensing/polygon_room.hpp"

namespace cca {
namespace {

std::vector<FittedRun> clustersOf(const ScanPoints& points, const PointNoise& noise) {
  return pointClusters(points, RunFitter(points.positions, noise));
}

TEST(PointClusters, CoverAllPointsOnceInOrder) {
  std::mt19937 random(4);
  const ScanPoints points = scanPoints(turnIn(rectangle(-2.0, -1.0, 3.0, 2.0), 0.1, &random), 0.1);
  int next = 0;
  for (const FittedRun& c : clustersOf(points, {0.1, 0.001, 0.0})) {
    EXPECT_EQ(c.first, next);
    EXPECT_GT(c.size(), 0);
    next = c.last;
  }
  EXPECT_EQ(next, 360);
}

TEST(PointClusters, LieOnOneLineWithinTheNoise) {
  std::mt19937 random(4);
  const ScanPoints points = scanPoints(turnIn(rectangle(-2.0, -1.0, 3.0, 2.0), 0.02, &random));
  const PrefixMoments prefix(points.positions);
  const auto clusters = clustersOf(points, {0.02, 0.0, 0.0});
  ASSERT_GE(clusters.size(), 4U);  // the room has so many walls
  for (const FittedRun& c : clusters) {
    const FittedLine line = fitLine(prefix.run(c.first, c.last));
    for (int i = c.first; i < c.last; ++i) {
      const Eigen::Vector2d off = points.positions[i] - line.centroid;
      const double d = line.direction.x() * off.y() - line.direction.y() * off.x();
      EXPECT_LT(std::abs(d), 4.0 * 0.02);
    }
  }
}

TEST(PointClusters, FallApartAtStepsAndMissingReturns) {
  Scan scan;
  scan.angle_increment = 0.01;
  scan.ranges.assign(40, 1.0);
  for (int i = 20; i < 40; ++i) scan.ranges[i] = 3.0;
  scan.ranges[10] = std::numeric_limits<double>::infinity();
  const ScanPoints points = scanPoints(scan);
  bool at_silence = false, at_step = false;
  for (const FittedRun& c : clustersOf(points, {0.035, 0.001, 0.0})) {
    at_silence = at_silence || c.first == 10;
    at_step = at_step || c.first == 19;
  }
  EXPECT_TRUE(at_silence);
  EXPECT_TRUE(at_step);
}

TEST(PointClusters, OfNothingAndOfOnePointAreNothingAndOne) {
  Scan scan;
  EXPECT_TRUE(clustersOf(scanPoints(scan), {0.01, 0.001, 0.0}).empty());
  scan.angle_increment = 0.01;
  scan.ranges = {1.0};
  EXPECT_EQ(clustersOf(scanPoints(scan), {0.01, 0.001, 0.0}).size(), 1u);
}

}  // namespace
}  // namespace cca
