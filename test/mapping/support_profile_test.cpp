// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/support_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

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
  const std::vector<Stretch> stretches = profile.stretches();
  ASSERT_EQ(stretches.size(), 2u);
  EXPECT_NEAR(stretches[0].range.last * SupportProfile::kBinLength, 1.0, 0.11);
  EXPECT_NEAR(stretches[1].range.first * SupportProfile::kBinLength, 1.9, 0.11);
}

TEST(SupportProfile, SpansTheGapsThatItCloses) {
  SupportProfile profile;
  const auto bins = {0, 5, 11};  // gaps of four and of five bins
  for (const int i : bins) profile.hit((i + 0.5) * SupportProfile::kBinLength, 0.0);
  for (int i = -2; i <= 13; ++i) {
    const bool is_hit = i == 0 || i == 5 || i == 11;
    EXPECT_EQ(profile.spans(i), is_hit || (i > 0 && i < 5)) << i;
  }
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
  EXPECT_LE(profile.bin(SupportProfile::binOf(0.51)).hits(), 1000.0);
  EXPECT_EQ(profile.last() - profile.first(), 1);
}

TEST(SupportProfile, NoBinHoldsLessThanNothingWhereAnotherEndsOnItsBorder) {
  for (int j = 1; j < 400; ++j) {
    const double border = j * SupportProfile::kBinLength;
    for (const double last : {std::nextafter(border, 0.0), border, std::nextafter(border, 99.0)}) {
      SupportBin bin;
      for (const double t : {border - 0.02, last}) bin.hit(t, 0.0);
      SupportProfile profile;
      profile.add(bin);
      EXPECT_NEAR(profile.tally().returns.w, 2.0, 1e-9);
      for (int i = profile.first(); i < profile.last(); ++i) EXPECT_GE(profile.bin(i).hits(), 0.0);
    }
  }
}

TEST(SupportProfile, ForgetsWhatRaysHaveRefuted) {
  SupportProfile profile = straight(0.0, 1.0);
  for (double t = 0.0; t < 1.0; t += 0.002) profile.pass(t);
  for (double t = 0.0; t < 1.0; t += 0.002) profile.pass(t);
  EXPECT_EQ(profile.prune().size(), 20u);
  EXPECT_TRUE(profile.empty());
}

/// The same bins without anything remembered of them.
SupportProfile anew(SupportProfile profile) { return profile.cutFrom(profile.first()); }

void expectSameStretches(const SupportProfile& a, const SupportProfile& b) {
  const std::vector<Stretch> all = a.stretches(), others = b.stretches();
  ASSERT_EQ(all.size(), others.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Stretch &s = all[k], &t = others[k];
    EXPECT_EQ(s.range.first, t.range.first);
    EXPECT_EQ(s.range.last, t.range.last);
    EXPECT_NEAR(s.tally.fitted.xy, t.tally.fitted.xy, 1e-9);
    EXPECT_NEAR(s.tally.returns.xx, t.tally.returns.xx, 1e-7);
  }
}

TEST(SupportProfile, RemembersWhatItsBinsSay) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> somewhere(0.0, 3.0), share(0.0, 1.0);
  SupportProfile profile = straight(0.0, 3.0);
  for (int k = 0; k < 20000; ++k) {
    const double t = somewhere(random), kind = share(random);
    // Hits everywhere, rays mostly through a door that opens and shuts.
    const bool open = k / 2000 % 2 == 1;
    const double at = open && kind < 0.9 ? 1.0 + 0.3 * t : t;
    if (kind < (open ? 0.1 : 0.95)) {
      // As neighbouring beams do, several in one place.
      for (int n = 0; n <= k % 4; ++n) profile.hit(at, 0.02 * share(random));
    } else if (!profile.pass(at)) {
      SupportProfile unchanged = anew(profile);
      expectSameStretches(profile, unchanged);
      EXPECT_TRUE(unchanged.prune().empty());
    }
    if (k % 7 == 0) profile.prune();
    for (int i = profile.first(); k % 7 == 0 && i < profile.last(); ++i) {
      const SupportBin& bin = profile.bin(i);
      EXPECT_FALSE(bin.hits() > 0.0 && bin.passed > 4.0 && bin.passed > 2.0 * bin.hits());
    }
    if (k % 5 == 0) expectSameStretches(profile, anew(profile));
    if (HasFailure()) FAIL() << "after " << k << " steps";
  }
}

}  // namespace
}  // namespace cca
