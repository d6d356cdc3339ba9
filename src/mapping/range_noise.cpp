// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/range_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cca {
namespace {

constexpr double kUniformToSigma = 0.28867513459481287;  // 1 / sqrt 12
/// Deviation of a beam's bearing, in spacings: a beam lies somewhere in a quarter of its own
/// sector.
constexpr double kBearingShare = 0.25 * kUniformToSigma;

/// The smallest step between neighbouring ranges: the quantum, where ranges are rounded. Not sought
/// below `least`.
double rangeQuantum(const std::vector<double>& ranges, double least) {
  constexpr double kRounding = 1e-9;
  double quantum = 0.0;
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    if (!isReturn(ranges[i - 1]) || !isReturn(ranges[i])) continue;
    const double step = std::abs(ranges[i] - ranges[i - 1]);
    if (step <= kRounding || (quantum > 0.0 && step >= quantum)) continue;
    quantum = step;
    if (quantum <= least) break;
  }
  return quantum;
}

struct Deviation {
  double slope;  // |r(i+1) - r(i-1)|
  double value;  // |e(i)|
};

std::vector<Deviation> deviations(const Scan& scan) {
  const double two_cos = 2.0 * std::cos(scan.angle_increment);
  const auto inverse = [](double range) { return isReturn(range) ? 1.0 / range : 0.0; };
  std::vector<Deviation> found;
  if (scan.size() < 3) return found;
  found.reserve(scan.size());
  double q_before = inverse(scan.ranges[0]), q_here = inverse(scan.ranges[1]);
  for (std::size_t i = 1; i + 1 < scan.size(); ++i) {
    const double q_after = inverse(scan.ranges[i + 1]), r = scan.ranges[i];
    if (q_before > 0.0 && q_here > 0.0 && q_after > 0.0) {
      const double e = std::abs(r * (r * (q_before + q_after) - two_cos));
      const double slope = std::abs(scan.ranges[i + 1] - scan.ranges[i - 1]);
      if (std::isfinite(e)) found.push_back({slope, e});
    }
    q_before = q_here;
    q_here = q_after;
  }
  return found;
}

/// Of the half with the smaller slopes.
double medianDeviation(std::vector<Deviation>* all) {
  const auto middle = all->begin() + static_cast<std::ptrdiff_t>(all->size() / 2);
  std::nth_element(all->begin(), middle, all->end(),
                   [](const Deviation& a, const Deviation& b) { return a.slope < b.slope; });
  std::vector<double> values;
  values.reserve(all->size() / 2 + 1);
  for (auto d = all->begin(); d <= middle; ++d) values.push_back(d->value);
  const auto median = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), median, values.end());
  return *median;
}

}  // namespace

PointNoise rangeNoise(const Scan& scan) {
  PointNoise noise;
  noise.range_sigma = kFinestSigma;
  noise.bearing_sigma = kBearingShare * std::abs(scan.angle_increment);
  std::vector<Deviation> all = deviations(scan);
  if (all.empty()) return noise;
  const double sigma =
      std::max(kFinestSigma, kMedianToSigma * medianDeviation(&all) / kSecondDifference);
  const double quantum = rangeQuantum(scan.ranges, sigma / kUniformToSigma);
  noise.range_sigma = std::max(sigma, kUniformToSigma * quantum);
  return noise;
}

}  // namespace cca
