// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/sensor_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "geometry/median.hpp"

namespace cca {
namespace {

constexpr std::size_t kHalf = 3;      // neighbours to each side: the slant is that of six spacings
constexpr std::size_t kEnough = 100;  // deviations, for a median to be told
constexpr std::size_t kLeastAtOnce = 5;  // in a scan: clutter looks slanted, too
constexpr std::size_t kScansKept = 50;   // scans: the mean follows in five seconds
constexpr double kLeastSlant = 1.0;      // tangent of the angle of incidence
constexpr double kLeastSlope = 3.0;      // m: below, half a degree is less than 3 cm of range noise
constexpr double kMostBend = 0.5;  // of the rise: an edge or a corner has all of it at one place

}  // namespace

double SensorNoise::variance(double range) const {
  const double across = range * bearing_sigma_;
  return std::max(range_sigma_ * range_sigma_, across * across);
}

void SensorNoise::add(const Scan& scan, double range_sigma) {
  scans_ = std::min(scans_ + 1, kScansKept);
  range_sigma_ += (range_sigma - range_sigma_) / static_cast<double>(scans_);
  const std::vector<Deviation> found = slanted(scan);
  if (found.size() < kLeastAtOnce) return;
  for (const Deviation& d : found) {
    if (kept_.size() < kKept) kept_.emplace_back();
    kept_[seen_++ % kKept] = d;
  }
  if (kept_.size() < kEnough) return;
  std::vector<double> across, along;
  for (const Deviation& d : kept_) {
    across.push_back(d.across);
    along.push_back(d.along);
  }
  const double all = kMedianToSigma * median(std::move(across)),
               of_range = median(std::move(along));
  bearing_sigma_ = std::sqrt(std::max(0.0, all * all - of_range * of_range));
}

std::vector<SensorNoise::Deviation> SensorNoise::slanted(const Scan& scan) const {
  std::vector<Deviation> found;
  constexpr std::size_t kWindow = 2 * kHalf + 1;
  const double spacing = scan.angle_increment;
  const double two_cos = 2.0 * std::cos(spacing), two_cos_far = 2.0 * std::cos(kHalf * spacing);
  for (std::size_t first = 0; first + kWindow <= scan.size(); ++first) {
    std::array<double, kWindow> q;
    bool all_return = true;
    for (std::size_t k = 0; k < kWindow && all_return; ++k) {
      all_return = isReturn(scan.ranges[first + k]);
      q[k] = 1.0 / scan.ranges[first + k];
    }
    if (!all_return) continue;
    const double rise = std::abs(q.back() - q.front()), r = scan.ranges[first + kHalf];
    const double slope = r * r * rise / (2.0 * kHalf * std::abs(spacing));
    if (slope < std::max(kLeastSlope, kLeastSlant * r)) continue;
    bool is_steady = std::abs(q.front() - two_cos_far * q[kHalf] + q.back()) < kMostBend * rise;
    for (std::size_t k = 0; k + 1 < kWindow; ++k)
      is_steady = is_steady && std::abs(q[k + 1] - q[k]) < kMostBend * rise;
    const double e =
        r * r * std::abs(q[kHalf - 1] - two_cos * q[kHalf] + q[kHalf + 1]) / kSecondDifference;
    if (!is_steady || !std::isfinite(e / slope)) continue;
    found.push_back({e / slope, range_sigma_ / slope});
  }
  return found;
}

}  // namespace cca
