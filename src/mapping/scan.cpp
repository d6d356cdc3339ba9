// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/scan.hpp"

#include <algorithm>

namespace cca {
namespace {

/// A scan that lacks less than half a beam of a full turn joins its ends.
bool isFullTurn(const Scan& scan) {
  const double spacing = std::abs(scan.angle_increment);
  return (static_cast<double>(scan.size()) + 0.5) * spacing > 2.0 * M_PI;
}

/// Where to open the circle: after a missing return, else at the sharpest bend of the ranges.
std::size_t cutOfCircle(const std::vector<double>& ranges) {
  const std::size_t n = ranges.size();
  std::size_t cut = 0;
  double sharpest = -1.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double before = ranges[(i + n - 1) % n], here = ranges[i], after = ranges[(i + 1) % n];
    if (!isReturn(here) || !isReturn(after)) continue;
    if (!isReturn(before)) return i;
    const double bend = std::abs(before + after - 2.0 * here);
    if (bend > sharpest) {
      sharpest = bend;
      cut = i;
    }
  }
  return cut;
}

/// A wall seen at less than this angle cannot be told from a step in depth [Borges & Aldon 2004].
constexpr double kGrazing = 4.0 * M_PI / 180.0;

/// 99.9 % of normal differences lie within this many deviations.
constexpr double kNoiseGate = 3.29;

/// Counts a step where neighbours lie farther apart than any wall would place them.
void countBreaks(ScanPoints* points) {
  points->breaks = points->silent;
  const double widest = std::sin(points->beam_spacing) / std::sin(kGrazing);
  const double noise = kNoiseGate * std::sqrt(2.0) * points->point_sigma;
  int steps = 0;
  for (std::size_t i = 1; i < points->size(); ++i) {
    const Eigen::Vector2d &p = points->positions[i - 1], &q = points->positions[i];
    const double beams = points->beams[i] - points->beams[i - 1];
    const double reach_sq =
        beams * beams * widest * widest * std::min(p.squaredNorm(), q.squaredNorm());
    // Most neighbours are nearer than noise or reach alone, which takes no root to see.
    const double apart_sq = (q - p).squaredNorm();
    if (apart_sq > std::max(noise * noise, reach_sq)) {
      const double most = noise + std::sqrt(reach_sq);
      if (apart_sq > most * most) ++steps;
    }
    points->breaks[i] += steps;
  }
}

}  // namespace

void TurningBeam::aimAt(std::size_t beam) {
  const double bearing = first_bearing_ + static_cast<double>(beam) * spacing_;
  unit_ = {std::cos(bearing), std::sin(bearing)};
  turns_left_ = kTurnsPerSine;
}

void reopen(int first, ScanPoints* points) {
  const int size = static_cast<int>(points->size());
  const auto rotate = [first](auto* v) { std::rotate(v->begin(), v->begin() + first, v->end()); };
  const int beams = points->beam_count, first_beam = points->beams[first];
  const int silent_before = points->silent[first], all = points->silent_in_all;
  rotate(&points->positions);
  rotate(&points->beams);
  rotate(&points->silent);
  for (int i = 0; i < size; ++i) {
    const bool wrapped = i >= size - first;
    points->beams[i] += (wrapped ? beams : 0) - first_beam;
    points->silent[i] += (wrapped ? all : 0) - silent_before;
  }
  countBreaks(points);
}

ScanPoints scanPoints(const Scan& scan, double point_sigma) {
  ScanPoints points;
  points.point_sigma = point_sigma;
  points.beam_spacing = std::abs(scan.angle_increment);
  if (!std::isfinite(scan.angle_min) || !std::isfinite(points.beam_spacing) ||
      points.beam_spacing <= 0.0) {
    return points;
  }
  const bool clockwise = scan.angle_increment < 0.0;
  std::vector<double> ranges = scan.ranges;
  if (clockwise) std::reverse(ranges.begin(), ranges.end());
  const std::size_t n = scan.size();
  const double first_bearing = clockwise && n > 0 ? scan.bearing(n - 1) : scan.angle_min;
  points.closed = isFullTurn(scan);
  const std::size_t cut = points.closed ? cutOfCircle(ranges) : 0;

  points.positions.reserve(n);
  points.beams.reserve(n);
  points.silent.reserve(n);
  TurningBeam direction(first_bearing, points.beam_spacing);
  int silent = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t beam = i + cut < n ? i + cut : i + cut - n;
    direction.turnTo(beam);
    const double range = ranges[beam];
    silent += isNoReturn(range) ? 1 : 0;
    if (!isReturn(range) || range > kLongestRange) continue;
    points.positions.push_back(range * direction.unit());
    points.beams.push_back(static_cast<int>(i));
    points.silent.push_back(silent);
  }
  points.silent_in_all = silent;
  points.beam_count = static_cast<int>(n);
  countBreaks(&points);
  return points;
}

}  // namespace cca
