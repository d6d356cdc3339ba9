// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/cross.hpp"

#include "log_score_parts.hpp"

namespace cca::log_score {
namespace {

constexpr double kLeast = 0.05, kWindow = 0.10, kHitDistance = 0.10;  // m
constexpr double kRaysAScan = 180.0;

/// Evenly spaced scan numbers, first and last included, halves rounded to even.
std::set<std::size_t> pickScans(std::size_t n, std::size_t most) {
  std::set<std::size_t> picked;
  const std::size_t m = std::min(n, most);
  for (std::size_t k = 0; k < m; ++k) {
    const double at =
        m > 1 ? static_cast<double>(n - 1) * static_cast<double>(k) / static_cast<double>(m - 1)
              : 0.0;
    picked.insert(static_cast<std::size_t>(std::nearbyint(at)));
  }
  return picked;
}

/// Crossings per sample, and the end points of the rays that were tested.
struct Evidence {
  std::vector<double> crossings;
  std::vector<Eigen::Vector2d> hits;
};

void testScan(const Scan& scan, const std::vector<Segment2>& map, const MapSamples& samples,
              const LogScoreParameters& p, FreeSpace& out, Evidence& evidence) {
  const auto stride = static_cast<std::size_t>(
      std::max(1.0, std::nearbyint(static_cast<double>(scan.size()) / kRaysAScan)));
  const Eigen::Vector2d origin = scan.T_map_sensor.position();
  double reach = 0.0;
  for (std::size_t i = 0; i < scan.size(); i += stride) {
    if (counts(scan.ranges[i])) reach = std::max(reach, std::min(scan.ranges[i], p.range_max));
  }
  std::vector<std::size_t> near;
  for (std::size_t s = 0; s < map.size(); ++s) {
    if (distance(origin, map[s]) < reach) near.push_back(s);
  }
  for (std::size_t i = 0; i < scan.size(); i += stride) {
    if (!counts(scan.ranges[i])) continue;
    ++out.rays;
    const double theta = scan.bearing(i) + scan.T_map_sensor.theta;
    const Eigen::Vector2d u(std::cos(theta), std::sin(theta));
    if (scan.ranges[i] <= p.range_max) evidence.hits.push_back(origin + scan.ranges[i] * u);
    const double range = std::min(scan.ranges[i], p.range_max);
    bool crossed = false, crossed_robustly = false;
    for (const std::size_t s : near) {
      const Eigen::Vector2d start = map[s].start - origin, along = map[s].end - map[s].start;
      const double den = cross(u, along);
      if (std::abs(den) <= 1e-12) continue;
      const double t = cross(start, along) / den, f = cross(start, u) / den;
      if (t <= kLeast || f < 0.0 || f > 1.0 || t >= range - p.free_space_margin) continue;
      crossed = true;
      if ((range - t) * std::abs(den) / along.norm() <= p.free_space_depth) continue;
      crossed_robustly = true;
      ++out.crossings;
      const auto bin = std::min(static_cast<std::size_t>(f * static_cast<double>(samples.count[s])),
                                samples.count[s] - 1);
      evidence.crossings[samples.first[s] + bin] += 1.0;
    }
    out.violating += crossed;
    out.violating_robust += crossed_robustly;
  }
}

}  // namespace

FreeSpace freeSpace(const std::vector<Scan>& scans, const std::vector<Segment2>& map,
                    const MapSamples& samples, const LogScoreParameters& p) {
  FreeSpace out;
  out.contradicted.assign(samples.size(), false);
  const auto picked = pickScans(scans.size(), static_cast<std::size_t>(p.max_ray_scans));
  out.scans_used = picked.size();
  if (map.empty()) return out;
  Evidence evidence;
  evidence.crossings.assign(samples.size(), 0.0);
  for (const std::size_t k : picked) testScan(scans[k], map, samples, p, out, evidence);

  // Crossings and hits are compared over windows of +-10 cm, so that the bin width does not matter.
  const PointIndex hits(evidence.hits);
  const double bin = *std::max_element(samples.length.begin(), samples.length.end());
  const auto half =
      static_cast<std::size_t>(std::max(1.0, std::nearbyint(kWindow / std::max(bin, 1e-9))));
  std::vector<std::size_t> near;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const std::size_t s = samples.segment[k], first = samples.first[s];
    const std::size_t low = k >= first + half ? k - half : first;
    const std::size_t high = std::min(k + half + 1, first + samples.count[s]);
    double crossings = 0.0;
    for (std::size_t b = low; b < high; ++b) crossings += evidence.crossings[b];
    if (crossings < 2.0) continue;
    hits.within(samples.xy[k], kHitDistance, near);
    out.contradicted[k] = crossings > static_cast<double>(near.size());
  }
  return out;
}

}  // namespace cca::log_score
