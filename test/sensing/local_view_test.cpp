// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/local_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "../navigation/box_world.hpp"

namespace cca::testing {
namespace {

constexpr double kGap = 0.6;

std::size_t surfaceEnds(const LocalView& view) {
  return static_cast<std::size_t>(std::count(view.ends_here.begin(), view.ends_here.end(), true));
}

BoxWorld longWall() {
  BoxWorld world;
  world.add(-50, 0.5, 50, 0.6);
  return world;
}

TEST(LocalView, AWallIsOneSurfaceDownToGrazingIncidence) {
  const Scan scan = longWall().scan({0, 0, 0}, 2.5);
  EXPECT_EQ(surfaceEnds(makeLocalView(scan, {}, {}, kGap)), 1u);
}

TEST(LocalView, SurfacesAreSampledWithoutHoles) {
  const LocalView view = makeLocalView(longWall().scan({0, 0, 0}, 2.5), {}, {}, kGap);
  for (std::size_t i = 0; i + 1 < view.obstacles.size(); ++i) {
    if (view.ends_here[i]) continue;
    EXPECT_LE((view.obstacles[i + 1] - view.obstacles[i]).norm(), 0.051);
  }
}

TEST(LocalView, ADoorEndsTheSurfacesBesideIt) {
  BoxWorld world;
  world.add(-5, 2, -0.45, 2.1);
  world.add(0.45, 2, 5, 2.1);
  const LocalView view = makeLocalView(world.scan({0, 0, 0}, 8), {}, {}, kGap);
  EXPECT_EQ(surfaceEnds(view), 2u);  // at the door, and behind the robot
}

TEST(LocalView, ReturnsAreAllThereEvenWhereObstaclesAreThinned) {
  BoxWorld world;
  world.add(-0.1, 0.3, 0.1, 0.4);  // beams meet it 5 mm apart
  const Scan scan = world.scan({0, 0, 0}, 8);
  const LocalView view = makeLocalView(scan, {}, {}, kGap);
  EXPECT_EQ(view.returns.size(), static_cast<std::size_t>(std::count_if(
                                     scan.ranges.begin(), scan.ranges.end(), isReturn)));
  EXPECT_LT(2 * view.obstacles.size(), view.returns.size());
}

TEST(LocalView, OneInvalidBeamDoesNotTearAWall) {
  Scan scan = longWall().scan({0, 0, 0}, 2.5);
  scan.ranges[270] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(surfaceEnds(makeLocalView(scan, {}, {}, kGap)), 1u);
}

TEST(LocalView, ClockwiseBeamsSeeTheSame) {
  BoxWorld world = longWall();
  world.add(1.0, -1.0, 1.5, -0.5);
  const Scan scan = world.scan({0, 0, 0.3}, 6, 181, M_PI);
  Scan clockwise = scan;
  std::reverse(clockwise.ranges.begin(), clockwise.ranges.end());
  clockwise.angle_min = scan.bearing(scan.size() - 1);
  clockwise.angle_increment = -scan.angle_increment;
  const LocalView a = makeLocalView(scan, {}, {}, kGap), b = makeLocalView(clockwise, {}, {}, kGap);
  EXPECT_EQ(surfaceEnds(a), surfaceEnds(b));
  const Eigen::Vector2d p(0.3, 0.2), beside(-0.2, -3.0);
  EXPECT_NEAR(a.seenDistanceTowards(p), b.seenDistanceTowards(p), 1e-9);
  EXPECT_EQ(a.inFieldOfView(beside), b.inFieldOfView(beside));
}

TEST(LocalView, SeesToTheReturnOrToTheRangeOrNotAtAll) {
  Scan scan;
  scan.angle_min = -0.1;
  scan.angle_increment = 0.1;
  scan.ranges = {3.0, INFINITY, std::nan("")};
  scan.free_range_without_return = 8.0;
  const LocalView view = makeLocalView(scan, {}, {}, kGap);
  const auto seen = [&](double bearing) {
    return view.seenDistanceTowards({std::cos(bearing), std::sin(bearing)});
  };
  EXPECT_DOUBLE_EQ(seen(-0.1), 3.0);
  EXPECT_DOUBLE_EQ(seen(0.0), 8.0);
  EXPECT_DOUBLE_EQ(seen(0.1), 0.0);
  EXPECT_DOUBLE_EQ(seen(2.0), 0.0);
}

TEST(LocalView, OfNoBeamsSeesNothing) {
  const LocalView view = makeLocalView({}, {}, {}, kGap);
  EXPECT_TRUE(view.obstacles.empty());
  EXPECT_DOUBLE_EQ(view.horizon, 0.0);
  EXPECT_DOUBLE_EQ(view.seenDistanceTowards({1, 0}), 0.0);
}

}  // namespace
}  // namespace cca::testing
