// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/scan.hpp"

#include <algorithm>

namespace cca {
namespace {

/// A turn that lacks less than this many beam spacings is a full one.
constexpr double kClosedWithinBeams = 1.5;

bool isFullTurn(const Scan& scan) {
  const double spacing = std::abs(scan.angle_increment);
  return static_cast<double>(scan.size()) * spacing >
         2.0 * M_PI - (kClosedWithinBeams - 1.0) * spacing;
}

/// The beam after the largest step in range around the circle; a missing return is a step.
std::size_t cutOfCircle(const std::vector<double>& ranges) {
  std::size_t cut = 0;
  double largest = -1.0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double before = ranges[i == 0 ? ranges.size() - 1 : i - 1], here = ranges[i];
    if (!isReturn(here)) continue;
    if (!isReturn(before)) return i;
    const double step = std::abs(here - before) / std::min(here, before);
    if (step > largest) {
      largest = step;
      cut = i;
    }
  }
  return cut;
}

}  // namespace

ScanPoints scanPoints(const Scan& scan) {
  ScanPoints points;
  points.beam_spacing = std::abs(scan.angle_increment);
  if (!std::isfinite(scan.angle_min) || !std::isfinite(points.beam_spacing) ||
      points.beam_spacing <= 0.0) {
    return points;
  }
  const bool clockwise = scan.angle_increment < 0.0;
  points.beam_ranges = scan.ranges;
  if (clockwise) std::reverse(points.beam_ranges.begin(), points.beam_ranges.end());
  const double first_bearing = clockwise ? scan.bearing(scan.size() - 1) : scan.angle_min;

  const std::size_t n = scan.size();
  const std::size_t cut = isFullTurn(scan) ? cutOfCircle(points.beam_ranges) : 0;
  std::rotate(points.beam_ranges.begin(),
              points.beam_ranges.begin() + static_cast<std::ptrdiff_t>(cut),
              points.beam_ranges.end());
  points.positions.reserve(n);
  points.beams.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double range = points.beam_ranges[i];
    if (!isReturn(range)) continue;
    const double bearing = first_bearing + static_cast<double>((i + cut) % n) * points.beam_spacing;
    points.positions.emplace_back(range * std::cos(bearing), range * std::sin(bearing));
    points.beams.push_back(static_cast<int>(i));
  }
  return points;
}

}  // namespace cca
