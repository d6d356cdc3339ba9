// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/scan_smoothing.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/mapping/range_noise.hpp"

namespace cca {
namespace {

constexpr double kWantedSigma = 0.005;  // m
constexpr double kPatch = 0.03;         // m, to each side
constexpr double kGate = 3.0 * 2.45;    // sigmas, of a second difference

}  // namespace

Scan smoothScan(const Scan& scan) {
  const double sigma = rangeNoise(scan).range_sigma;
  if (sigma <= kWantedSigma) return scan;
  const double wanted = 0.5 * (std::pow(sigma / kWantedSigma, 2) - 1.0);
  Scan smooth = scan;
  const auto n = static_cast<int>(scan.size());
  for (int i = 0; i < n; ++i) {
    const double range = scan.ranges[static_cast<std::size_t>(i)];
    if (!isReturn(range)) continue;
    const double patch = kPatch / (range * std::abs(scan.angle_increment));
    const int reach =
        std::min({static_cast<int>(std::ceil(std::min(patch, wanted))), i, n - 1 - i});
    double sum = range;
    int count = 1;
    for (int k = 1; k <= reach; ++k) {
      const double left = scan.ranges[static_cast<std::size_t>(i + k)];
      const double right = scan.ranges[static_cast<std::size_t>(i - k)];
      if (!isReturn(left) || !isReturn(right)) continue;
      if (std::abs(left + right - 2.0 * range) > kGate * sigma) continue;
      sum += left + right;
      count += 2;
    }
    smooth.ranges[static_cast<std::size_t>(i)] = sum / count;
  }
  return smooth;
}

}  // namespace cca
