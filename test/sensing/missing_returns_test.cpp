// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/missing_returns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace cca::missing_returns_test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr int kBeams = 360;

/// A laser of one degree in a room of this radius; beam 200 sees farther.
Scan around(double radius, double farthest, double declared) {
  Scan scan;
  scan.angle_increment = 2.0 * M_PI / kBeams;
  scan.ranges.assign(kBeams, radius);
  scan.ranges[200] = farthest;
  scan.free_range_without_return = declared;
  return scan;
}

void lose(Scan& scan, int first, int count) {
  for (int i = 0; i < count; ++i) scan.ranges[(first + i) % kBeams] = kInf;
}

/// m, how far the beam has seen free space.
double freeRange(MissingReturns& learned, Scan scan, int beam) {
  learned.judge(scan);
  return scan.freeRange(beam);
}

Scan withOpening(double farthest, double declared) {
  Scan scan = around(2.0, farthest, declared);
  lose(scan, 100, 20);
  return scan;
}

TEST(MissingReturns, OfALaserThatSeesAsFarAsItSaysAreFreeSpace) {
  MissingReturns learned;
  EXPECT_EQ(freeRange(learned, withOpening(7.8, 8.0), 110), 8.0);
  EXPECT_EQ(freeRange(learned, withOpening(1.5, 8.0), 110), 8.0);
}

TEST(MissingReturns, OfALaserThatDeclaresMoreThanItSeesTellNothing) {
  MissingReturns learned;
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(freeRange(learned, withOpening(30.0, 80.0), 110), 0.0);
  }
}

TEST(MissingReturns, OneFalseReadingDoesNotBearThemOut) {
  MissingReturns learned;
  for (int k = 0; k < 100; ++k) freeRange(learned, withOpening(30.0, 80.0), 110);
  EXPECT_EQ(freeRange(learned, withOpening(79.0, 80.0), 110), 0.0);
}

TEST(MissingReturns, OfAScanThatSeesNothingAtAllTellNothing) {
  MissingReturns learned;
  EXPECT_EQ(freeRange(learned, withOpening(7.8, 8.0), 110), 8.0);
  Scan blind = around(2.0, 2.0, 8.0);
  lose(blind, 0, kBeams);
  EXPECT_EQ(freeRange(learned, blind, 110), 0.0);
  for (int k = 0; k < 1000; ++k) freeRange(learned, blind, 110);
  EXPECT_EQ(freeRange(learned, withOpening(1.5, 8.0), 110), 8.0);
}

TEST(MissingReturns, AreOpenAcrossTheSeamOfAFullTurn) {
  MissingReturns learned;
  Scan scan = around(2.0, 7.8, 8.0);
  lose(scan, 350, 20);
  for (const int beam : {350, 359, 0, 9}) EXPECT_EQ(freeRange(learned, scan, beam), 8.0);
}

TEST(MissingReturns, OfAScanThatEndsInThemAreOpen) {
  MissingReturns learned;
  Scan scan = around(2.0, 7.8, 8.0);
  scan.angle_increment *= 0.5;
  lose(scan, 330, 30);
  EXPECT_EQ(freeRange(learned, scan, 340), 8.0);
  EXPECT_EQ(freeRange(learned, scan, 359), 8.0);
}

TEST(MissingReturns, OfADoorSeenAcrossARoomAreOpenThoughBeamsAreLost) {
  MissingReturns learned;
  Scan scan = around(5.0, 7.8, 8.0);
  for (int i = 3; i < kBeams; i += 33) lose(scan, i, 1);
  lose(scan, 100, 10);  // 0.87 m
  EXPECT_EQ(freeRange(learned, scan, 105), 8.0);
}

TEST(MissingReturns, BetweenInvalidBeamsAreComparedWithTheReturnsBeyondThem) {
  MissingReturns learned;
  Scan scan = around(0.5, 7.8, 8.0);
  lose(scan, 100, 10);  // 9 cm at half a metre
  scan.ranges[99] = scan.ranges[110] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(freeRange(learned, scan, 105), 0.0);
}

// No wall of this corridor may be seen through, whatever is lost: it is what opened maps.
TEST(MissingReturns, LostAtRandomOpenNoWall) {
  std::mt19937 generator(3);
  for (const double share : {0.03, 0.1}) {
    MissingReturns learned;
    std::bernoulli_distribution is_lost(share);
    int opened = 0, kept = 0;
    for (int k = 0; k < 2000; ++k) {
      Scan scan;
      scan.angle_increment = 2.0 * M_PI / kBeams;
      scan.free_range_without_return = 8.0;
      for (int i = 0; i < kBeams; ++i) {
        const double wall = 1.0 / std::abs(std::sin(scan.bearing(i) + 0.003));
        scan.ranges.push_back(wall > 7.99 || is_lost(generator) ? kInf : wall);
      }
      learned.judge(scan);
      for (int i = 0; i < kBeams; ++i) {
        const double wall = 1.0 / std::abs(std::sin(scan.bearing(i) + 0.003));
        opened += isNoReturn(scan.ranges[i]) && wall < 6.0;
        kept += isNoReturn(scan.ranges[i]) && wall > 20.0;
      }
      EXPECT_EQ(scan.free_range_without_return, 8.0);
    }
    EXPECT_LE(opened, 2000 * 1e-2) << share;  // beams in a run that came about once in 1000 scans
    EXPECT_GT(kept, 2000 * 5 * 2 * 0.9) << share;  // the ends of the corridor stay open
  }
}

TEST(MissingReturns, AreReadingsAtTheEndOfTheDeclaredRange) {
  for (const double reading : {8.0, 7.9999, 7.993, 8.5}) {
    MissingReturns learned;
    Scan scan = around(2.0, 7.8, 8.0);
    std::fill_n(scan.ranges.begin() + 100, 20, reading);
    scan.ranges[300] = reading;
    learned.judge(scan);
    EXPECT_TRUE(isNoReturn(scan.ranges[110])) << reading;
    EXPECT_EQ(scan.freeRange(110), 8.0) << reading;
    EXPECT_TRUE(std::isnan(scan.ranges[300])) << reading;
  }
}

TEST(MissingReturns, AreReadingsAtTheTopOfWhatIsRead) {
  MissingReturns learned;
  Scan scan = around(2.0, 5.3, 30.0);
  std::fill_n(scan.ranges.begin() + 100, 20, 5.6);
  scan.ranges[300] = 5.6;
  learned.judge(scan);
  EXPECT_TRUE(isNoReturn(scan.ranges[110]));
  EXPECT_TRUE(std::isnan(scan.ranges[300]));
  EXPECT_NEAR(scan.freeRange(110), 5.6, 0.23);
}

}  // namespace
}  // namespace cca::missing_returns_test
