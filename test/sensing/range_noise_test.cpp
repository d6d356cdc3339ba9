// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/range_noise.hpp"

#include <gtest/gtest.h>

#include "polygon_room.hpp"

namespace cca {
namespace {

TEST(RangeNoise, IsThatOfTheRangesInARoom) {
  std::mt19937 random(3);
  const PolygonRoom room = rectangle(-2.0, -1.5, 4.0, 3.0);
  for (const double sigma : {0.005, 0.01, 0.03, 0.1, 0.2}) {
    double sum = 0.0;
    for (int k = 0; k < 20; ++k) sum += rangeNoise(turnIn(room, sigma, &random)).range_sigma;
    EXPECT_NEAR(sum / 20.0 / sigma, 1.0, 0.12) << sigma;
  }
}

TEST(RangeNoise, TakesNoWallForNoiseHoweverItIsSeen) {
  Scan scan;  // a noise-free wall down to 5 degrees of incidence, coarse beams
  scan.angle_min = 5.0 * M_PI / 180.0;
  scan.angle_increment = 2.0 * M_PI / 180.0;
  for (std::size_t i = 0; i < 80; ++i) scan.ranges.push_back(1.0 / std::sin(scan.bearing(i)));
  EXPECT_EQ(rangeNoise(scan).range_sigma, kFinestSigma);
}

TEST(RangeNoise, IgnoresTheMinorityOfStepsAndCorners) {
  std::mt19937 random(5);
  Scan scan = turnIn(rectangle(-2.0, -1.5, 4.0, 3.0), 0.02, &random);
  for (std::size_t i = 0; i < scan.size(); i += 20) scan.ranges[i] *= 0.3;
  EXPECT_NEAR(rangeNoise(scan).range_sigma, 0.02, 0.008);
}

TEST(RangeNoise, IsNotBelowTheRoundingOfTheRanges) {
  Scan scan;
  scan.angle_increment = 0.001;
  for (int i = 0; i < 200; ++i) scan.ranges.push_back(2.0 + 0.05 * (i / 100));
  EXPECT_NEAR(rangeNoise(scan).range_sigma, 0.05 / std::sqrt(12.0), 1e-6);
}

TEST(RangeNoise, HasAFloorWhereTheScanSaysNothing) {
  Scan scan;
  EXPECT_EQ(rangeNoise(scan).range_sigma, kFinestSigma);
  scan.angle_increment = 0.01;
  scan.ranges = {1.0, std::nan(""), 1e-300, 1e300, 1.0, -1.0};
  EXPECT_TRUE(std::isfinite(rangeNoise(scan).range_sigma));
}

TEST(PointNoise, FadesAcrossAGrazingWallButNotBelowTheBearings) {
  const PointNoise noise{0.03, 0.002, 0.0};
  const Eigen::Vector2d p(4.0, 0.0), head_on(0.0, 1.0), grazing(1.0, 0.0);
  EXPECT_NEAR(std::sqrt(noise.onLine(p, head_on).across), 0.03, 1e-4);
  EXPECT_NEAR(std::sqrt(noise.onLine(p, grazing).across), 4.0 * 0.002, 1e-4);
}

TEST(PointNoise, IsTheSameForADirectionAndItsDoubleAngle) {
  const PointNoise noise{0.03, 0.002, 0.0};
  for (double angle = -3.0; angle < 3.0; angle += 0.37) {
    const Eigen::Vector2d p(2.0, 1.0), u(std::cos(angle), std::sin(angle));
    PrincipalAxis axis;
    axis.cos_2 = std::cos(2.0 * angle);
    axis.sin_2 = std::sin(2.0 * angle);
    EXPECT_NEAR(noise.onLine(p, u).across, noise.onLine(p, axis).across, 1e-15);
    EXPECT_NEAR(noise.onLine(p, u).along, noise.onLine(p, axis).along, 1e-15);
  }
}

TEST(PointNoise, IsNotFinerAcrossThanAWallIsStraight) {
  const Eigen::Vector2d p(4.0, 0.0), head_on(0.0, 1.0), grazing(1.0, 0.0);
  const PointNoise fine{0.005, 0.0, 0.035}, coarse{0.2, 0.0, 0.035};
  EXPECT_NEAR(std::sqrt(fine.onLine(p, head_on).across), 0.035, 1e-4);
  EXPECT_NEAR(std::sqrt(coarse.onLine(p, head_on).across), 0.2, 1e-4);
  EXPECT_NEAR(std::sqrt(fine.onLine(p, grazing).along), 0.005, 1e-12);
}

}  // namespace
}  // namespace cca
