// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/near_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "../navigation/box_world.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca::testing {
namespace {

constexpr double kSigma = 0.03;

class NoisyLaser {
 public:
  explicit NoisyLaser(unsigned seed) : generator_(seed) {}
  /// One update by a scan of a world.
  Scan look(const BoxWorld& world, const Pose2& pose, double sigma = kSigma) {
    const Scan raw = noisy(world.scan(pose, 3.0), sigma, generator_);
    const std::vector<bool> moving(raw.size(), false);
    return surfaces_.update(raw, smoothScan(raw, sigma), moving, sigma);
  }

 private:
  std::mt19937 generator_;
  NearSurfaces surfaces_;
};

/// The least that a scan leaves to both sides of a passage along x, taken together.
double width(const Scan& scan) {
  double left = 3.0, right = 3.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!isReturn(scan.ranges[i]) || scan.ranges[i] > 0.5) continue;
    const double y = scan.ranges[i] * std::sin(scan.T_map_sensor.theta + scan.bearing(i));
    (y > 0.0 ? left : right) = std::min(y > 0.0 ? left : right, std::abs(y));
  }
  return left + right;
}

TEST(NearSurfaces, LeaveAPreciseScanAsItIs) {
  BoxWorld world;
  world.addFrame(2, 2);
  NoisyLaser laser(1);
  const Scan truth = world.scan({1, 1, 0.3}, 3.0);
  EXPECT_EQ(laser.look(world, {1, 1, 0.3}, 0.0).ranges, truth.ranges);
}

// A single scan, smoothed as it is, takes 11 cm of its 55: the nearest of all its returns.
TEST(NearSurfaces, GiveAPassageBackMostOfItsWidth) {
  BoxWorld passage;
  passage.add(-2.0, 0.275, 2.0, 0.4);
  passage.add(-2.0, -0.4, 2.0, -0.275);
  double least = 1.0, mean = 0.0, mean_before = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    NoisyLaser laser(seed);
    Scan scan;
    for (int i = 0; i < 20; ++i) scan = laser.look(passage, {0.01 * i, 0.0, 0.05 * i});
    least = std::min(least, width(scan));
    mean += width(scan) / 20;
    mean_before += width(NoisyLaser(seed).look(passage, {})) / 20;
  }
  EXPECT_LT(mean_before, 0.55 - 0.1);
  EXPECT_GT(mean, 0.55 - 0.03);
  EXPECT_GT(least, 0.55 - 0.04);
  EXPECT_LT(mean, 0.55);
}

TEST(NearSurfaces, DoNotPushACornerBack) {
  BoxWorld world;
  world.add(0.3, -1.0, 1.0, 0.0);
  const Pose2 pose{0.0, 0.3, 0.0};  // the corner is seen at 45 degrees
  const auto corner = static_cast<std::size_t>(std::lround((-0.25 * M_PI + M_PI) / (M_PI / 180.0)));
  const Scan truth = world.scan(pose, 3.0);
  double bias = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    NoisyLaser laser(seed);
    Scan scan;
    for (int i = 0; i < 20; ++i) scan = laser.look(world, pose);
    for (const std::size_t k : {corner - 1, corner, corner + 1})
      bias += (scan.ranges[k] - truth.ranges[k]) / 60;
  }
  ASSERT_LT(truth.ranges[corner], 0.45);
  EXPECT_LT(bias, 0.008);
  EXPECT_GT(bias, -0.02);
}

TEST(NearSurfaces, DoNotPushAnEdgeBackTowardsWhatLiesJustBehindIt) {
  BoxWorld world;
  world.add(-1.0, 0.3, 0.0, 0.4);
  world.add(0.0, 0.38, 1.0, 0.5);
  const Scan truth = world.scan({-0.02, 0, 0}, 3.0);
  double bias = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    NoisyLaser laser(seed);
    Scan scan;
    for (int i = 0; i < 20; ++i) scan = laser.look(world, {-0.02, 0, 0});
    bias += (scan.ranges[267] - truth.ranges[267]) / 20;  // the last beams on the nearer wall
  }
  ASSERT_LT(truth.ranges[267], 0.31);
  EXPECT_LT(bias, 0.012);
}

// A post before a wall that only the present scan shows, and one that it shows no longer.
TEST(NearSurfaces, GoByWhatThePresentScanShows) {
  BoxWorld wall, post;
  wall.add(1.0, -1.0, 1.1, 1.0);
  post.add(1.0, -1.0, 1.1, 1.0);
  post.add(0.7, -0.02, 0.74, 0.02);
  NoisyLaser laser(1);
  for (int i = 0; i < 20; ++i) laser.look(wall, {});
  EXPECT_LT(laser.look(post, {}).ranges[180], 0.8);
  EXPECT_GT(laser.look(wall, {}).ranges[180], 0.9);
}

TEST(NearSurfaces, KeepWhatIsNoReturn) {
  Scan scan;
  scan.angle_increment = 0.01;
  scan.ranges = {1.0, std::nan(""), 1.3, INFINITY, 0.9, 1.0, -1.0, 1.2, 0.8};
  NearSurfaces surfaces;
  for (int step = 0; step < 3; ++step) {
    const Scan steady = surfaces.update(scan, scan, std::vector<bool>(scan.size(), false), 0.05);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      EXPECT_EQ(isReturn(steady.ranges[i]), isReturn(scan.ranges[i]));
      EXPECT_EQ(isNoReturn(steady.ranges[i]), isNoReturn(scan.ranges[i]));
    }
  }
  EXPECT_TRUE(surfaces.update({}, {}, {}, 0.05).ranges.empty());
}

}  // namespace
}  // namespace cca::testing
