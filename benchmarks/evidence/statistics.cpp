// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "simulation/random.hpp"

namespace cca::evidence {
namespace {

constexpr int kResamples = 1000;
constexpr double kTail = 0.025;

double mean(std::vector<double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

template <class Statistic>
BootstrapEstimate bootstrap(const std::vector<double>& values, std::uint64_t seed,
                            Statistic statistic) {
  if (values.empty()) return {};
  const int last = static_cast<int>(values.size()) - 1;
  Random random(seed);
  std::vector<double> found, resample(values.size());
  for (int k = 0; k < kResamples; ++k) {
    for (double& value : resample)
      value = values[static_cast<std::size_t>(random.integer(0, last))];
    found.push_back(statistic(resample));
  }
  return {statistic(values), quantile(found, kTail), quantile(found, 1.0 - kTail)};
}

}  // namespace

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

BootstrapEstimate bootstrapMean(const std::vector<double>& values, std::uint64_t seed) {
  return bootstrap(values, seed, mean);
}

BootstrapEstimate bootstrapMedian(const std::vector<double>& values, std::uint64_t seed) {
  return bootstrap(values, seed, median);
}

}  // namespace cca::evidence
