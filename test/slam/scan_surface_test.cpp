// SPDX-License-Identifier: BSD-3-Clause
#include "slam/scan_surface.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "walled_world.hpp"

namespace cca {
namespace {

TEST(ScanSurface, NormalsOfARoomPointAtTheSensorAcrossItsWalls) {
  test::WalledWorld world;
  world.addBox(-3.0, -2.0, 4.0, 2.5);
  const ScanSurface surface = scanSurface(world.scan({0.3, 0.1, 0.4}, 361, M_PI));
  ASSERT_EQ(surface.points.size(), 361u);
  int with_normal = 0;
  for (const auto& point : surface.points) {
    if (point.normal.isZero()) continue;
    ++with_normal;
    EXPECT_LT(point.normal.dot(point.position), 0.0);
    const double angle = std::atan2(point.normal.y(), point.normal.x()) + 0.4;
    EXPECT_NEAR(std::remainder(angle, M_PI_2), 0.0, 0.01);
  }
  EXPECT_GT(with_normal, 350);
}

/// A wall's facets are chords: their own normals are up to half a chord's angle off.
TEST(ScanSurface, NormalsOfARoundHallPointAtItsCentre) {
  constexpr int kChords = 180;  // each bulges by a millimetre, a tenth of the noise
  const auto at = [](int k) -> Eigen::Vector2d {
    return 7.0 *
           Eigen::Vector2d(std::cos(2.0 * M_PI * k / kChords), std::sin(2.0 * M_PI * k / kChords));
  };
  test::WalledWorld world;
  for (int k = 0; k < kChords; ++k) world.addWall(at(k), at(k + 1));
  for (const double sigma : {0.01, 0.03}) {
    for (int k = 0; k < 10; ++k) {
      const Pose2 pose{0.3 * k - 1.0, 2.0, 0.2 * k};
      Scan scan = world.scan(pose, 361, 2.0 * M_PI, sigma);
      // Lost beams, as MissingReturns tells them: no two scans lose the same.
      for (std::size_t i = static_cast<std::size_t>(k); i < scan.size(); i += 33) {
        scan.ranges[i] = std::numeric_limits<double>::quiet_NaN();
      }
      double sum_sq = 0.0, count = 0.0;
      for (const auto& point : scanSurface(scan).points) {
        if (point.normal.isZero()) continue;
        const Eigen::Vector2d inward = -(pose * point.position).normalized();
        const double off = cross(Pose2{0.0, 0.0, pose.theta} * point.normal, inward);
        sum_sq += off * off;
        ++count;
      }
      EXPECT_GT(count, 200.0);
      EXPECT_LT(std::sqrt(sum_sq / count), 0.03) << sigma << " " << k;
    }
  }
}

TEST(ScanSurface, EachBeamFindsItsOwnReturn) {
  test::WalledWorld world;
  world.addBox(-3.0, -2.0, 4.0, 2.5);
  for (const double field_of_view : {M_PI, 1.5 * M_PI, 2.0 * M_PI}) {
    const ScanSurface surface = scanSurface(world.scan({}, 360, field_of_view));
    for (const auto& point : surface.points) {
      EXPECT_EQ(surface.beamTowards(point.position), point.beam) << field_of_view;
    }
  }
}

TEST(ScanSurface, LooksNowhereBehindAHalfTurn) {
  test::WalledWorld world;
  world.addBox(-3.0, -2.0, 4.0, 2.5);
  const ScanSurface surface = scanSurface(world.scan({}, 181, M_PI));
  EXPECT_EQ(surface.beamTowards({-1.0, 0.1}), -1);
  EXPECT_GE(surface.beamTowards({1.0, 0.1}), 0);
}

TEST(ScanSurface, AClockwiseScanIsTheSameSurface) {
  test::WalledWorld world;
  world.addBox(-3.0, -2.0, 4.0, 2.5);
  Scan scan = world.scan({0.3, 0.1, 0.4}, 181, M_PI);
  const ScanSurface surface = scanSurface(scan);
  scan.angle_min = scan.bearing(180);
  scan.angle_increment = -scan.angle_increment;
  std::reverse(scan.ranges.begin(), scan.ranges.end());
  const ScanSurface turned = scanSurface(scan);
  ASSERT_EQ(turned.points.size(), surface.points.size());
  for (std::size_t k = 0; k < surface.points.size(); ++k) {
    EXPECT_LT((turned.points[k].position - surface.points[k].position).norm(), 1e-9);
  }
}

TEST(ScanSurface, NothingIsSeenInUselessScans) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scan scan;
  EXPECT_TRUE(scanSurface(scan).points.empty());
  scan.ranges = {1.0, 1.0, 1.0, 1.0};
  EXPECT_TRUE(scanSurface(scan).points.empty()) << "no spacing";
  scan.angle_increment = nan;
  EXPECT_TRUE(scanSurface(scan).points.empty());
  scan.angle_increment = 0.01;
  scan.ranges = {nan, -1.0, 0.0, HUGE_VAL, -HUGE_VAL};
  EXPECT_TRUE(scanSurface(scan).points.empty());
}

}  // namespace
}  // namespace cca
