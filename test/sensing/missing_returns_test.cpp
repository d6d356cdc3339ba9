// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/missing_returns.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cca::missing_returns_test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

double freeRange(MissingReturns& learned, std::vector<double> ranges, double declared) {
  Scan scan;
  scan.angle_increment = 0.01;
  scan.ranges = std::move(ranges);
  scan.free_range_without_return = declared;
  learned.judge(scan);
  return scan.free_range_without_return;
}

TEST(MissingReturns, OfALaserThatSeesAsFarAsItSaysAreFreeSpace) {
  MissingReturns learned;
  EXPECT_EQ(freeRange(learned, {2.0, 7.8, kInf, kInf}, 8.0), 8.0);
  EXPECT_EQ(freeRange(learned, {2.0, 1.5, kInf, kInf}, 8.0), 8.0);
}

TEST(MissingReturns, OfALaserThatDeclaresMoreThanItSeesTellNothing) {
  MissingReturns learned;
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(freeRange(learned, {2.0, 30.0, kInf, kInf}, 80.0), 0.0);
  }
}

TEST(MissingReturns, OneFalseReadingDoesNotBearThemOut) {
  MissingReturns learned;
  for (int k = 0; k < 100; ++k) freeRange(learned, {2.0, 30.0, kInf, kInf}, 80.0);
  EXPECT_EQ(freeRange(learned, {2.0, 79.0, kInf, kInf}, 80.0), 0.0);
}

TEST(MissingReturns, OfAScanThatSeesNothingAtAllTellNothing) {
  MissingReturns learned;
  EXPECT_EQ(freeRange(learned, {2.0, 7.8, kInf, kInf}, 8.0), 8.0);
  EXPECT_EQ(freeRange(learned, {kInf, kInf, kInf, kInf}, 8.0), 0.0);
  for (int k = 0; k < 1000; ++k) freeRange(learned, {kInf, kInf, kInf, kInf}, 8.0);
  EXPECT_EQ(freeRange(learned, {2.0, 1.5, kInf, kInf}, 8.0), 8.0);
}

}  // namespace
}  // namespace cca::missing_returns_test
