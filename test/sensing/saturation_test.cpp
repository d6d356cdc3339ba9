// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/saturation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cca::saturation_test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// What a laser of one degree sees from (x, y) in a room of 8 m x 6 m.
Scan roomFrom(double x, double y, int beams = 360, double quantum = 0.0) {
  Scan scan;
  scan.angle_increment = 2.0 * M_PI / 360.0;
  for (int i = 0; i < beams; ++i) {
    const double c = std::cos(scan.bearing(i)), s = std::sin(scan.bearing(i));
    const double across = ((c > 0.0 ? 4.0 : -4.0) - x) / c,
                 along = ((s > 0.0 ? 3.0 : -3.0) - y) / s;
    const double range = std::min(across, along);
    scan.ranges.push_back(quantum > 0.0 ? quantum * std::round(range / quantum) : range);
  }
  return scan;
}

TEST(Saturation, FindsBeamsThatAreLostHereAndThere) {
  Saturation found;
  Scan scan = roomFrom(0.5, 0.3);
  for (int i = 7; i < 360; i += 40) scan.ranges[i] = 11.98;
  found.add(scan);
  EXPECT_LE(found.threshold(), 11.98);
  EXPECT_GT(found.threshold(), 11.5);
}

TEST(Saturation, FindsAnOpenSideThoughTheCodesDiffer) {
  Saturation found;
  Scan scan = roomFrom(0.5, 0.3);
  for (int i = 100; i < 140; ++i) scan.ranges[i] = i % 3 ? 81.83 : 81.91;
  found.add(scan);
  EXPECT_LE(found.threshold(), 81.83);
}

TEST(Saturation, IsFoundWhereItStandsAloneWhileTheRobotMoves) {
  Saturation found;
  for (double x = -3.5; x <= 3.5; x += 0.25) {
    Scan scan = roomFrom(x, 0.3);
    scan.ranges[100] = 51.1;
    found.add(scan);
  }
  EXPECT_LE(found.threshold(), 51.1);
}

TEST(Saturation, IsNotALoneFarBeamWhileTheRobotStands) {
  Saturation found;
  Scan scan = roomFrom(0.5, 0.3);
  scan.ranges[100] = 12.0;
  for (int k = 0; k < 1000; ++k) found.add(scan);
  EXPECT_EQ(found.threshold(), kInf);
}

TEST(Saturation, IsNotTheFarWallOfARoomWhereverTheRobotStands) {
  for (const double quantum : {0.0, 0.01, 0.05}) {
    Saturation found;
    for (double x = -3.5; x <= 3.5; x += 0.5) {
      for (double y = -2.5; y <= 2.5; y += 0.5) {
        found.add(roomFrom(x, y, 360, quantum));
        EXPECT_EQ(found.threshold(), kInf) << x << ' ' << y << ' ' << quantum;
      }
    }
  }
}

TEST(Saturation, IsNotTheEndOfACorridorThatTheRobotStaysBefore) {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.002);
  Saturation found;
  for (int k = 0; k < 100; ++k) {
    Scan scan;
    scan.angle_min = -0.5 * M_PI;
    scan.angle_increment = M_PI / 720.0;
    for (int i = 0; i <= 720; ++i) {
      const double bearing = scan.bearing(i);
      const double range = std::min(10.0 / std::cos(bearing), 1.0 / std::abs(std::sin(bearing)));
      scan.ranges.push_back(0.01 * std::round(100.0 * (range + noise(generator))));
    }
    found.add(scan);
    EXPECT_EQ(found.threshold(), kInf);
  }
}

TEST(Saturation, IsNotWhatTheSameDistanceAllAroundIs) {
  Saturation found;
  Scan scan = roomFrom(0.0, 0.0);
  scan.ranges.assign(360, 2.0);
  found.add(scan);
  EXPECT_EQ(found.threshold(), kInf);
}

TEST(Saturation, IsNotWhatStandsEquallyFarHereAndThere) {
  // As the ends of racks in a warehouse: six of three beams each, read with a noise of 5 mm.
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.005);
  Saturation found;
  for (int k = 0; k < 100; ++k) {
    Scan scan = roomFrom(0.5, 0.3);
    for (double& range : scan.ranges) range += noise(generator);
    for (int i = 7; i < 360; i += 60) {
      for (int beam = i; beam < i + 3; ++beam) scan.ranges[beam] = 11.46 + noise(generator);
    }
    found.add(scan);
    EXPECT_EQ(found.threshold(), kInf);
  }
}

TEST(Saturation, OutlivesAFalseReadingBeyondIt) {
  Saturation found;
  Scan scan = roomFrom(0.5, 0.3);
  for (int i = 100; i < 140; ++i) scan.ranges[i] = 30.0;
  for (int k = 0; k < 10; ++k) found.add(scan);
  scan.ranges[200] = 55.0;
  found.add(scan);
  EXPECT_LE(found.threshold(), 30.0);
}

TEST(Saturation, IsNoneOnceFartherSurfacesAreSeenAgainAndAgain) {
  Saturation found;
  Scan scan = roomFrom(0.5, 0.3);
  for (int i = 100; i < 140; ++i) scan.ranges[i] = 12.0;
  found.add(scan);
  scan.ranges[200] = 14.0;
  found.add(scan);
  EXPECT_EQ(found.threshold(), kInf);
}

}  // namespace
}  // namespace cca::saturation_test
