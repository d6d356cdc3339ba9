// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/place/scan_smoothing.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr double kWantedSigma = 0.005;  // m
constexpr double kPatch = 0.03;         // m, to each side
constexpr double kFarther = 0.75;       // sigmas
constexpr double kGate = 3.0 * 2.45;    // sigmas, of a second difference

}  // namespace

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
      if (std::abs(left + right - 2.0 * range) > kGate * range_sigma) continue;
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
