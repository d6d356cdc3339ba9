// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/range_noise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cca {
namespace {

constexpr double kMadToSigma = 1.4826;  // median |x| of a normal variable, inverted
constexpr double kSecondDifference = 2.449489742783178;  // sqrt(1 + 4 + 1)
constexpr double kUniformToSigma = 0.28867513459481287;  // 1 / sqrt 12

/// The smallest step between neighbouring ranges: the quantum, where ranges are rounded.
double rangeQuantum(const Scan& scan) {
  double quantum = 0.0;
  for (std::size_t i = 1; i < scan.size(); ++i) {
    if (!isReturn(scan.ranges[i - 1]) || !isReturn(scan.ranges[i])) continue;
    const double step = std::abs(scan.ranges[i] - scan.ranges[i - 1]);
    if (step > 1e-9 && (quantum == 0.0 || step < quantum)) quantum = step;
  }
  return quantum;
}

}  // namespace

double PointNoise::lateralVariance(const Eigen::Vector2d& point,
                                   const Eigen::Vector2d& direction) const {
  const double range_sq = point.squaredNorm();
  const double along = point.dot(direction);
  const double across_sq = std::max(0.0, range_sq - along * along);
  const double head_on = range_sq > 0.0 ? across_sq / range_sq : 1.0;
  return range_sigma * range_sigma * head_on + bearing_sigma * bearing_sigma * along * along;
}

PointNoise rangeNoise(const Scan& scan) {
  const double two_cos = 2.0 * std::cos(scan.angle_increment);
  std::vector<double> deviations;
  deviations.reserve(scan.size());
  for (std::size_t i = 1; i + 1 < scan.size(); ++i) {
    const double a = scan.ranges[i - 1], b = scan.ranges[i], c = scan.ranges[i + 1];
    if (!isReturn(a) || !isReturn(b) || !isReturn(c)) continue;
    deviations.push_back(std::abs(b * b * (1.0 / a + 1.0 / c) - two_cos * b));
  }
  PointNoise noise{kFinestSigma, kUniformToSigma * std::abs(scan.angle_increment)};
  if (deviations.empty()) return noise;
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  noise.range_sigma = std::max({kFinestSigma, kMadToSigma * *middle / kSecondDifference,
                                kUniformToSigma * rangeQuantum(scan)});
  return noise;
}

}  // namespace cca
