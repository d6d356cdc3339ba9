// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mapping/laser_evidence.hpp"

namespace cca {
namespace {

Scan evenScan(std::size_t beams, double angle_min, double increment) {
  Scan scan;
  scan.ranges.assign(beams, 5.0);
  scan.angle_min = angle_min;
  scan.angle_increment = increment;
  return scan;
}

/// Whether beams that meet the stretch lie in the ranges.
void expectFound(const Scan& scan, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const auto ranges = beamsTowards(scan, a, b, 0.0);
  for (double share = 0.0; share <= 1.0; share += 0.01) {
    const Eigen::Vector2d p = a + share * (b - a) - scan.T_map_sensor.position();
    const double turn =
        std::remainder(std::atan2(p.y(), p.x()) - scan.T_map_sensor.theta - scan.angle_min,
                       2.0 * M_PI) /
        scan.angle_increment;
    const double whole = 2.0 * M_PI / std::abs(scan.angle_increment);
    const auto beam = static_cast<std::size_t>(turn < 0.0 ? turn + whole : turn);
    if (beam >= scan.size()) continue;
    EXPECT_TRUE((beam >= ranges[0].first && beam < ranges[0].last) ||
                (beam >= ranges[1].first && beam < ranges[1].last))
        << beam;
  }
}

TEST(BeamsTowards, FindAStretchFromEitherSideAndAcrossTheSeam) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-5.0, 5.0), turn(-M_PI, M_PI);
  for (int trial = 0; trial < 200; ++trial) {
    const double increment = (trial % 2 == 0 ? 1.0 : -1.0) * M_PI / 180.0;
    Scan scan = evenScan(trial % 3 == 0 ? 360 : 181, turn(random), increment);
    scan.T_map_sensor = Pose2{place(random), place(random), turn(random)};
    const Eigen::Vector2d a(place(random), place(random)), b(place(random), place(random));
    expectFound(scan, a, b);
    expectFound(scan, b, a);
  }
}

TEST(PassRays, CountAgainstAWallFromEitherSide) {
  for (const double side : {-1.0, 1.0}) {
    Walls walls;
    const Walls::Slot slot = walls.create();
    for (double t = -2.0; t < 2.0; t += 0.01) walls[slot].profile.hit(t, 0.0);
    walls.place(slot);
    Scan scan = evenScan(180, -M_PI / 2.0, M_PI / 180.0);
    scan.T_map_sensor = Pose2{0.0, side, -side * M_PI / 2.0};
    passRays(scan, beamDirections(scan), MapNoise{}, walls);
    double passed = 0.0;
    for (int i = walls[slot].profile.first(); i < walls[slot].profile.last(); ++i) {
      passed += walls[slot].profile.bin(i).passed;
    }
    // Beams within atan 2 of the wall's normal meet it, and go on by more than their half.
    EXPECT_NEAR(passed, 2.0 * std::atan(2.0) * 180.0 / M_PI, 2.0);
    EXPECT_EQ(walls.touched().size(), 1u);
  }
}

TEST(PassRays, SayNothingWhereBearingsAreNotFinite) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {inf, -inf, std::nan(""), 1e307}) {
    Walls walls;
    const Walls::Slot slot = walls.create();
    for (double t = -2.0; t < 2.0; t += 0.01) walls[slot].profile.hit(t, 0.0);
    walls.place(slot);
    for (const bool first : {false, true}) {
      const Scan scan = first ? evenScan(180, bad, 0.01) : evenScan(180, 0.0, bad);
      passRays(scan, beamDirections(scan), MapNoise{}, walls);
    }
    ASSERT_FALSE(walls[slot].profile.empty());
    for (int i = walls[slot].profile.first(); i < walls[slot].profile.last(); ++i) {
      EXPECT_GE(walls[slot].profile.bin(i).hits(), 4.0);
    }
  }
}

}  // namespace
}  // namespace cca
