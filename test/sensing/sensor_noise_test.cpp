// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/sensor_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cca {
namespace {

/// A full turn in the middle of a corridor of 14 x 4 m.
Scan turnInACorridor(int beams, double range_sigma, double bearing_sigma, std::mt19937* random) {
  std::normal_distribution<double> normal;
  Scan scan;
  scan.angle_increment = 2.0 * M_PI / beams;
  scan.angle_min = -M_PI;
  for (int k = 0; k < beams; ++k) {
    const double bearing =
        scan.bearing(static_cast<std::size_t>(k)) + bearing_sigma * normal(*random);
    const double range =
        std::min(7.0 / std::abs(std::cos(bearing)), 2.0 / std::abs(std::sin(bearing)));
    scan.ranges.push_back(range + range_sigma * normal(*random));
  }
  return scan;
}

void add(SensorNoise& noise, const Scan& scan) { noise.add(scan, rangeNoise(scan).range_sigma); }

TEST(SensorNoise, IsLearnedAlongAndAcrossTheBeams) {
  for (const int beams : {181, 361, 541}) {
    for (const double bearing_sigma : {0.25 * kRadiansPerDegree, 0.5 * kRadiansPerDegree}) {
      std::mt19937 random(1);
      SensorNoise noise;
      for (int k = 0; k < 50; ++k) add(noise, turnInACorridor(beams, 0.02, bearing_sigma, &random));
      EXPECT_NEAR(noise.rangeSigma(), 0.02, 0.005) << beams;
      EXPECT_NEAR(noise.bearingSigma() / bearing_sigma, 1.0, 0.3) << beams;
      EXPECT_DOUBLE_EQ(noise.variance(20.0), std::pow(20.0 * noise.bearingSigma(), 2));
      EXPECT_DOUBLE_EQ(noise.variance(0.1), std::pow(noise.rangeSigma(), 2));
    }
  }
}

TEST(SensorNoise, TakesRangeNoiseForNoneOfTheBearing) {
  std::mt19937 random(2);
  for (const double range_sigma : {0.0, 0.01, 0.03}) {
    SensorNoise noise;
    for (int k = 0; k < 50; ++k) add(noise, turnInACorridor(361, range_sigma, 0.0, &random));
    EXPECT_LT(noise.bearingSigma(), 0.1 * kRadiansPerDegree) << range_sigma;
  }
}

TEST(SensorNoise, LearnsNothingOfTheBearingFromClutter) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(0.5, 8.0);
  SensorNoise noise;
  for (int k = 0; k < 200; ++k) {
    Scan scan;
    scan.angle_increment = 2.0 * kRadiansPerDegree;
    for (int i = 0; i < 180; ++i) scan.ranges.push_back(anywhere(random));
    add(noise, scan);
  }
  EXPECT_EQ(noise.bearingSigma(), 0.0);
}

TEST(SensorNoise, BearsScansOfAnyKind) {
  SensorNoise noise;
  Scan scan;
  add(noise, scan);
  scan.ranges.assign(20, std::numeric_limits<double>::quiet_NaN());
  add(noise, scan);
  scan.ranges = {1, 2, 3, 4, 5, 6, 7, 8};  // without a spacing
  add(noise, scan);
  EXPECT_TRUE(std::isfinite(noise.rangeSigma()));
  EXPECT_EQ(noise.bearingSigma(), 0.0);
}

}  // namespace
}  // namespace cca
