// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/range_noise.hpp"

#include <gtest/gtest.h>

#include <random>

#include "../navigation/box_world.hpp"

namespace cca::testing {
namespace {

TEST(ScanSmoothing, LeavesAPreciseScanAsItIs) {
  BoxWorld world;
  world.addFrame(4, 4);
  const Scan scan = world.scan({1, 1, 0.3}, 8.0);
  EXPECT_EQ(smoothScan(scan, 0.002).ranges, scan.ranges);
}

TEST(ScanSmoothing, QuietensAnInclinedWallNearbyWithoutMovingIt) {
  BoxWorld world;
  world.add(0.4, -5, 0.5, 5);
  const Scan truth = world.scan({0, 0, 0.5}, 3.0);
  double before = 0.0, after = 0.0, bias = 0.0;
  int count = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const Scan raw = noisy(truth, 0.05, random), smooth = smoothScan(raw, 0.05);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!isReturn(truth.ranges[i]) || truth.ranges[i] > 0.6) continue;
      before += std::pow(raw.ranges[i] - truth.ranges[i], 2);
      after += std::pow(smooth.ranges[i] - truth.ranges[i], 2);
      bias += smooth.ranges[i] - truth.ranges[i];
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(after / count), 0.55 * std::sqrt(before / count));
  // It may err to the near side, not to the far one.
  EXPECT_LT(bias / count, 0.004);
  EXPECT_GT(bias / count, -0.015);
}

TEST(ScanSmoothing, DoesNotAverageAThinPoleAway) {
  BoxWorld world;
  world.addFrame(6, 6);
  world.add(2.0, 0.98, 2.03, 1.02);
  const Scan truth = world.scan({1, 1, 0}, 8.0);
  std::mt19937 random(3);
  const Scan smooth = smoothScan(noisy(truth, 0.02, random), 0.02);
  EXPECT_NEAR(smooth.ranges[180], truth.ranges[180], 0.08);
}

TEST(ScanSmoothing, DoesNotPushAnEdgeBackTowardsWhatLiesJustBehindIt) {
  BoxWorld world;
  world.add(-1.0, 0.3, 0.0, 0.4);
  world.add(0.0, 0.5, 1.0, 0.6);
  const Scan truth = world.scan({-0.02, 0, 0}, 3.0);
  double bias = 0.0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const Scan smooth = smoothScan(noisy(truth, 0.03, random), 0.03);
    bias += smooth.ranges[267] - truth.ranges[267];  // the last beams on the nearer wall
  }
  ASSERT_LT(truth.ranges[267], 0.31);
  EXPECT_LT(bias / 50, 0.012);
}

TEST(ScanSmoothing, KeepsWhatIsNoReturn) {
  Scan scan;
  scan.angle_increment = 0.01;
  scan.ranges = {1.0, std::nan(""), 1.3, INFINITY, 0.9, 1.0, -1.0, 1.2, 0.8};
  const Scan smooth = smoothScan(scan, 0.05);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_EQ(isReturn(smooth.ranges[i]), isReturn(scan.ranges[i]));
    EXPECT_EQ(isNoReturn(smooth.ranges[i]), isNoReturn(scan.ranges[i]));
  }
  EXPECT_TRUE(smoothScan({}, 0.05).ranges.empty());
}

}  // namespace
}  // namespace cca::testing
