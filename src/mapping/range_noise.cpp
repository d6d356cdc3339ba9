// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/range_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cca {
namespace {

constexpr double kMedianToSigma = 1.4826;                // of |x|, x normal
constexpr double kSecondDifference = 2.449489742783178;  // sqrt(1 + 4 + 1)
constexpr double kUniformToSigma = 0.28867513459481287;  // 1 / sqrt 12
/// Deviation of a beam's bearing, in spacings: a beam lies somewhere in a quarter of its own
/// sector.
constexpr double kBearingShare = 0.25 * kUniformToSigma;

/// The smallest step between neighbouring ranges: the quantum, where ranges are rounded.
double rangeQuantum(const std::vector<double>& ranges) {
  constexpr double kRounding = 1e-9;
  double quantum = 0.0;
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    if (!isReturn(ranges[i - 1]) || !isReturn(ranges[i])) continue;
    const double step = std::abs(ranges[i] - ranges[i - 1]);
    if (step > kRounding && (quantum == 0.0 || step < quantum)) quantum = step;
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

template <class Less>
void lowerHalf(std::vector<Deviation>* all, Less less) {
  const auto middle = all->begin() + static_cast<std::ptrdiff_t>(all->size() / 2);
  std::nth_element(all->begin(), middle, all->end(), less);
  all->erase(middle + 1, all->end());
}

}  // namespace

PointNoise rangeNoise(const Scan& scan) {
  PointNoise noise;
  noise.range_sigma = kFinestSigma;
  noise.bearing_sigma = kBearingShare * std::abs(scan.angle_increment);
  std::vector<Deviation> all = deviations(scan);
  if (all.empty()) return noise;
  lowerHalf(&all, [](const Deviation& a, const Deviation& b) { return a.slope < b.slope; });
  lowerHalf(&all, [](const Deviation& a, const Deviation& b) { return a.value < b.value; });
  noise.range_sigma = std::max({kFinestSigma, kMedianToSigma * all.back().value / kSecondDifference,
                                kUniformToSigma * rangeQuantum(scan.ranges)});
  return noise;
}

}  // namespace cca
