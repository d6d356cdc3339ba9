// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace cca::evidence {

/// A mean or median with the interval that holds it with 95 % confidence.
struct BootstrapEstimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Mean and percentile bootstrap interval [Efron & Tibshirani 1993], 1000 resamples.
/// @param values  any number; zeros for none, an interval of no width for one.
BootstrapEstimate bootstrapMean(const std::vector<double>& values, std::uint64_t seed = 1);
/// The same for the median, which a few disturbed values do not move.
BootstrapEstimate bootstrapMedian(const std::vector<double>& values, std::uint64_t seed = 1);

/// The middle value; the mean of the two in the middle for an even number, 0 for none.
double median(std::vector<double> values);

/// Value below which the share `q` in [0, 1] lies, by linear interpolation; 0 for none.
double quantile(std::vector<double> values, double q);

}  // namespace cca::evidence
