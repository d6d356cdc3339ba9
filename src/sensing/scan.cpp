// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/scan.hpp"

#include <algorithm>
#include <utility>

#include "sensing/gates.hpp"

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
  if (n == 0) return cut;
  double before = ranges.back(), here = ranges.front();
  bool was_return = isReturn(before), is_return = isReturn(here);
  for (std::size_t i = 0; i < n; ++i) {
    const double after = ranges[i + 1 < n ? i + 1 : 0];
    const bool will_return = isReturn(after);
    if (is_return && will_return) {
      if (!was_return) return i;
      const double bend = std::abs(before + after - 2.0 * here);
      if (bend > sharpest) {
        sharpest = bend;
        cut = i;
      }
    }
    before = std::exchange(here, after);
    was_return = std::exchange(is_return, will_return);
  }
  return cut;
}

/// Tells a step in depth: neighbours that lie farther apart than any wall would place them.
class StepGate {
 public:
  explicit StepGate(const ScanPoints& points)
      : widest_(std::sin(points.beam_spacing) / std::sin(kGrazing)),
        noise_(kNormalGate * std::sqrt(2.0) * points.point_sigma) {}

  /// @param beams  how many of them farther q is.
  bool isStep(const Eigen::Vector2d& p, const Eigen::Vector2d& q, double beams) const {
    const double reach_sq =
        beams * beams * widest_ * widest_ * std::min(p.squaredNorm(), q.squaredNorm());
    // Most neighbours are nearer than noise or reach alone, which takes no root to see.
    const double apart_sq = (q - p).squaredNorm();
    if (apart_sq <= std::max(noise_ * noise_, reach_sq)) return false;
    const double most = noise_ + std::sqrt(reach_sq);
    return apart_sq > most * most;
  }

 private:
  double widest_, noise_;
};

void countBreaks(ScanPoints* points) {
  points->breaks = points->silent;
  const StepGate gate(*points);
  int steps = 0;
  for (std::size_t i = 1; i < points->size(); ++i) {
    const double beams = points->beams[i] - points->beams[i - 1];
    if (gate.isStep(points->positions[i - 1], points->positions[i], beams)) ++steps;
    points->breaks[i] += steps;
  }
}

/// Breaks of the whole circle: beams without return, steps, and the step over the seam, if it is
/// one.
int breaksInAll(const ScanPoints& points) {
  const int beams = points.beams.front() + points.beam_count - points.beams.back();
  const bool step_at_seam =
      StepGate(points).isStep(points.positions.back(), points.positions.front(), beams);
  const int steps = points.breaks.back() - points.silent.back();
  return points.silent_in_all + steps + (step_at_seam ? 1 : 0);
}

}  // namespace

void TurningBeam::aimAt(std::size_t beam) {
  const double bearing = first_bearing_ + static_cast<double>(beam) * spacing_;
  cosine_ = std::cos(bearing);
  sine_ = std::sin(bearing);
  turns_left_ = kTurnsPerSine;
}

void reopen(int first, ScanPoints* points) {
  const int size = static_cast<int>(points->size());
  const auto rotate = [first](auto* v) { std::rotate(v->begin(), v->begin() + first, v->end()); };
  const int beams = points->beam_count, first_beam = points->beams[first];
  const int silent_before = points->silent[first], silent_in_all = points->silent_in_all;
  const int breaks_before = points->breaks[first], breaks_in_all = breaksInAll(*points);
  rotate(&points->positions);
  rotate(&points->beams);
  rotate(&points->silent);
  rotate(&points->breaks);
  for (int i = 0; i < size; ++i) {
    const bool wrapped = i >= size - first;
    points->beams[i] += (wrapped ? beams : 0) - first_beam;
    points->silent[i] += (wrapped ? silent_in_all : 0) - silent_before;
    points->breaks[i] += (wrapped ? breaks_in_all : 0) - breaks_before;
  }
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

  points.positions.resize(n);
  points.beams.resize(n);
  points.silent.resize(n);
  TurningBeam direction(first_bearing, points.beam_spacing);
  int silent = 0;
  std::size_t returns = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t beam = i + cut < n ? i + cut : i + cut - n;
    direction.turnTo(beam);
    const double range = ranges[beam];
    silent += isNoReturn(range) ? 1 : 0;
    if (!isReturn(range) || range > kLongestRange) continue;
    points.positions[returns] = {range * direction.cosine(), range * direction.sine()};
    points.beams[returns] = static_cast<int>(i);
    points.silent[returns++] = silent;
  }
  points.positions.resize(returns);
  points.beams.resize(returns);
  points.silent.resize(returns);
  points.silent_in_all = silent;
  points.beam_count = static_cast<int>(n);
  countBreaks(&points);
  return points;
}

}  // namespace cca
