// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/random.hpp"

namespace cca::evidence {
namespace {

TEST(Quantile, InterpolatesBetweenRanks) {
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(quantile({}, 0.5), 0.0);
}

TEST(BootstrapMean, OfOneValueHasNoWidth) {
  const BootstrapEstimate e = bootstrapMean({3.0});
  EXPECT_DOUBLE_EQ(e.low, 3.0);
  EXPECT_DOUBLE_EQ(e.high, 3.0);
}

/// 95 % intervals hold the true mean in about 95 of 100 samples. With 200 samples the share lies in
/// [0.90, 0.985] but for one case in a thousand; percentile intervals of 50 values run a little
/// low.
TEST(BootstrapMean, IntervalsHoldTheTrueMeanAsOftenAsTheyClaim) {
  Random random(5);
  int held = 0;
  for (int sample = 0; sample < 200; ++sample) {
    std::vector<double> values;
    for (int i = 0; i < 50; ++i) values.push_back(2.0 + random.normal());
    const BootstrapEstimate e = bootstrapMean(values, 7);
    held += e.low <= 2.0 && 2.0 <= e.high;
  }
  EXPECT_GE(held, 180);
  EXPECT_LE(held, 197);
}

TEST(BootstrapMedian, IgnoresAFewDisturbedValues) {
  std::vector<double> values(100, 1.0);
  values[7] = values[70] = 1e6;
  EXPECT_DOUBLE_EQ(bootstrapMedian(values).value, 1.0);
  EXPECT_DOUBLE_EQ(bootstrapMedian(values).high, 1.0);
}

}  // namespace
}  // namespace cca::evidence
