// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/range_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/median.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

/// Deviation of a beam's bearing, in spacings: a beam lies somewhere in a quarter of its own
/// sector.
constexpr double kBearingShare = 0.25 * kUniformToSigma;

/// The smallest step between neighbouring ranges: the quantum, where ranges are rounded. Not sought
/// below `least`.
double rangeQuantum(const std::vector<double>& ranges, double least) {
  constexpr double kRounding = 1e-9;  // m; ranges that differ by less were printed alike
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
  return median(std::move(values));
}

constexpr double kWantedSigma = 0.005;  // m; the clearance of the driver allows for it
constexpr double kPatch = 0.03;         // m, to each side: no corner is rounded farther
constexpr double kFarther = 0.75;       // sigmas; beyond, an edge has been smoothed away

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

Scan smoothScan(const Scan& scan, double range_sigma) {
  if (range_sigma <= kWantedSigma) return scan;
  const double wanted = 0.5 * (std::pow(range_sigma / kWantedSigma, 2) - 1.0);
  Scan smooth = scan;
  const auto n = static_cast<int>(scan.size());
  for (int i = 0; i < n; ++i) {
    const double range = scan.ranges[static_cast<std::size_t>(i)];
    if (!isReturn(range)) continue;
    const double patch = kPatch / (range * std::abs(scan.angle_increment));
    const int reach =
        std::min({static_cast<int>(std::ceil(std::min(patch, wanted))), i, n - 1 - i});
    double sum_left = range, sum_right = range;
    int count = 1;
    for (int k = 1; k <= reach; ++k) {
      const double left = scan.ranges[static_cast<std::size_t>(i + k)];
      const double right = scan.ranges[static_cast<std::size_t>(i - k)];
      if (!isReturn(left) || !isReturn(right)) continue;
      if (std::abs(left + right - 2.0 * range) > kGates * kSecondDifference * range_sigma) continue;
      sum_left += left;
      sum_right += right;
      ++count;
    }
    double mean = (sum_left + sum_right - range) / (2 * count - 1);
    // Farther than measured: if this is an edge before a step within the noise, one side has it.
    if (mean > range + kFarther * range_sigma) mean = std::min(sum_left, sum_right) / count;
    smooth.ranges[static_cast<std::size_t>(i)] = mean;
  }
  return smooth;
}

}  // namespace cca
