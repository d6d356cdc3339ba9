// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/support_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cca {
namespace {

SupportProfile straight(double from, double to, double slope = 0.0, double offset = 0.0) {
  SupportProfile profile;
  for (double t = from; t < to; t += 0.01) profile.hit(t, offset + slope * t);
  return profile;
}

TEST(SupportProfile, FitsTheLineThatItsHitsLieOn) {
  const LateralFit fit = straight(-1.0, 2.0, 0.05, 0.3).fit();
  EXPECT_NEAR(fit.slope, 0.05, 1e-9);
  EXPECT_NEAR(fit.offset, 0.3, 1e-9);
}

TEST(SupportProfile, ADoorThatRaysPassThroughPartsTheWall) {
  SupportProfile profile = straight(0.0, 3.0);
  for (double t = 1.0; t < 1.9; t += 0.005) {
    for (int k = 0; k < 3; ++k) profile.pass(t);
  }
  std::vector<BinRange> ranges;
  profile.supportedRanges(5, ranges);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_NEAR(ranges[0].last * SupportProfile::kBinLength, 1.0, 0.11);
  EXPECT_NEAR(ranges[1].first * SupportProfile::kBinLength, 1.9, 0.11);
}

TEST(SupportProfile, CutsExactlyAtABend) {
  SupportProfile profile;
  for (double t = 0.0; t < 2.0; t += 0.01) profile.hit(t, t < 1.0 ? 0.0 : 0.3 * (t - 1.0));
  const SupportProfile::Cut cut = profile.bestCut();
  EXPECT_NEAR(cut.at * SupportProfile::kBinLength, 1.0, 0.06);
  const SupportProfile tail = profile.cutFrom(cut.at);
  EXPECT_NEAR(profile.fit().slope, 0.0, 1e-3);
  EXPECT_NEAR(tail.fit().slope, 0.3, 1e-2);
}

TEST(SupportProfile, CountsStayBoundedForever) {
  SupportProfile profile;
  for (int i = 0; i < 100000; ++i) profile.hit(0.51, 0.0);
  EXPECT_LE(profile.bin(SupportProfile::binOf(0.51)).hits, 1000.0);
  EXPECT_EQ(profile.last() - profile.first(), 1);
}

TEST(SupportProfile, ForgetsWhatRaysHaveRefuted) {
  SupportProfile profile = straight(0.0, 1.0);
  for (double t = 0.0; t < 1.0; t += 0.002) profile.pass(t);
  for (double t = 0.0; t < 1.0; t += 0.002) profile.pass(t);
  EXPECT_TRUE(profile.prune());
  EXPECT_TRUE(profile.empty());
}

}  // namespace
}  // namespace cca
