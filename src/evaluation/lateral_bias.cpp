// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/cross.hpp"
#include "log_score_parts.hpp"

namespace cca::log_score {
namespace {

constexpr double kStation = 0.25, kLateral = 0.15;  // m
constexpr std::size_t kFewestPoints = 5, kMostPoints = 400000;

}  // namespace

LateralBias lateralBias(const std::vector<Eigen::Vector2d>& points,
                        const std::vector<Segment2>& map, const SegmentIndex& index) {
  std::vector<std::size_t> first(1, 0), count;
  for (const auto& s : map) {
    count.push_back(
        static_cast<std::size_t>(std::max(1.0, std::ceil(s.length() / kStation - 1e-9))));
    first.push_back(first.back() + count.back());
  }
  std::vector<std::vector<double>> offsets(first.back());
  const std::size_t stride =
      points.size() > kMostPoints ? (points.size() + kMostPoints - 1) / kMostPoints : 1;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Neighbour hit = index.nearest(points[i], kLateral);
    if (hit.index == SegmentIndex::npos) continue;
    const Segment2& s = map[hit.index];
    const double length = s.length();
    const Eigen::Vector2d u = (s.end - s.start) / length, d = points[i] - s.start;
    const double along = d.dot(u) / length;
    if (along < 0.0 || along > 1.0) continue;
    const auto bin = static_cast<std::size_t>(along * static_cast<double>(count[hit.index]));
    offsets[first[hit.index] + std::min(bin, count[hit.index] - 1)].push_back(cross(u, d));
  }
  LateralBias bias;
  std::vector<double> medians, spreads;
  for (auto& station : offsets) {
    if (station.size() < kFewestPoints) continue;
    const double median = ranked(station, 0.5);
    for (double& offset : station) offset = std::abs(offset - median);
    medians.push_back(std::abs(median));
    spreads.push_back(ranked(station, 0.5));
  }
  bias.stations = medians.size();
  bias.rms = bias.p95 = bias.spread_median = std::numeric_limits<double>::quiet_NaN();
  if (medians.empty()) return bias;
  double sum = 0.0;
  for (const double m : medians) sum += m * m;
  bias.rms = std::sqrt(sum / static_cast<double>(medians.size()));
  bias.p95 = quantile(medians, 0.95);
  bias.spread_median = 1.4826 * quantile(spreads, 0.5);
  return bias;
}

}  // namespace cca::log_score
