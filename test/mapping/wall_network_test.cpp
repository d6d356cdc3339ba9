// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/wall_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mapped_world.hpp"

namespace cca {
namespace {

/// A corridor of 40 m along x, with piers, driven from one end to the other.
LineMap mapOfCorridor(LineMap::Poses poses) {
  SegmentWorld world;
  world.box(0.0, -1.5, 40.0, 1.5);
  for (double x = 3.0; x < 40.0; x += 5.0) world.box(x, 0.9, x + 0.6, 1.5);
  std::mt19937 random(1);
  LineMap map({}, poses);
  for (double x = 1.0; x < 39.0; x += 0.2) {
    map.insert(world.scan({x, -0.3, 0.0}, 0.01, random, 360, 8.0));
  }
  map.lookBack();
  return map;
}

/// The variance [m^2] of the place along x of what faces along the corridor at x.
double varianceAt(const LineMap& map, double x, double reach) {
  for (const MapLine& line : map.lines()) {
    const Eigen::Vector2d middle = 0.5 * (line.segment.start + line.segment.end);
    const bool faces_along = std::abs(line.segment.direction().x()) < 0.3;
    if (faces_along && std::abs(middle.x() - x) < reach) return line.segment.covariance(0, 0);
  }
  return -1.0;
}

TEST(WallNetwork, WallsFartherFromTheFirstScanAreKnownLess) {
  const LineMap map = mapOfCorridor(LineMap::Poses::kOwn);
  const double near = varianceAt(map, 0.0, 0.2), far = varianceAt(map, 40.0, 0.2);
  ASSERT_GT(near, 0.0);
  ASSERT_GT(far, 0.0);
  EXPECT_GT(far, 4.0 * near);
  EXPECT_LT(std::sqrt(far), 0.05);
}

TEST(WallNetwork, GivenPosesShareNoError) {
  const LineMap map = mapOfCorridor(LineMap::Poses::kGiven);
  const double near = varianceAt(map, 0.0, 0.2), far = varianceAt(map, 40.0, 0.2);
  ASSERT_GT(near, 0.0);
  ASSERT_GT(far, 0.0);
  EXPECT_LT(far, 3.0 * near);
  for (const Wall& wall : map.walls().all()) EXPECT_TRUE(wall.pose_covariance.isZero());
}

TEST(WallNetwork, MapWithoutScansIsLeftAlone) {
  LineMap map({}, LineMap::Poses::kOwn);
  map.lookBack();
  EXPECT_TRUE(map.lines().empty());
}

}  // namespace
}  // namespace cca
