// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/poly_lines.hpp"

#include <cmath>
#include <optional>

#include "geometry/cross.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

/// sin 3 deg: directions nearer than this do not fix where line and beam meet.
constexpr double kAlongTheLine = 0.05;
/// A corner takes this many beams at most from the line that they were fitted with.
constexpr int kMostTaken = 5;

/// Where the beam through p meets the line; the foot of p where the two are all but parallel.
Eigen::Vector2d onBeam(const FittedLine& line, const Eigen::Vector2d& p) {
  const double head_on = cross(p, line.direction);
  if (std::abs(head_on) > kAlongTheLine * p.norm()) {
    return p * (cross(line.centroid, line.direction) / head_on);
  }
  return line.centroid + line.direction.dot(p - line.centroid) * line.direction;
}

LineSegment segmentOf(const ScanPoints& points, const FittedSegment& fit, int first, int last) {
  LineSegment s;
  s.start = onBeam(fit.line, points.positions[first]);
  s.end = onBeam(fit.line, points.positions[last - 1]);
  s.moments = fit.moments;
  s.covariance(0, 0) = fit.variance / fit.moments.weight;
  s.covariance(1, 1) = fit.variance / fit.line.spread_sum_sq;
  return s;
}

bool liesOn(const FittedSegment& line, const Eigen::Vector2d& p) {
  const double off = cross(line.line.direction, p - line.line.centroid);
  return off * off <= kNormalGate * kNormalGate * line.variance;
}

/// A line of the scan, and the run of points at that end of it which is looked at.
struct LineEnd {
  const FittedSegment& fit;
  const FittedRun& run;
};

/// The corner of two lines, if the rays say that it is there: it lies between the last beam of a
/// and the first of b, or beyond a few beams that fit the other line as well.
std::optional<Eigen::Vector2d> cornerBetween(const ScanPoints& points, const LineEnd& a,
                                             const LineEnd& b) {
  const auto corner = intersection(a.fit.line, b.fit.line);
  int p = a.run.last - 1, q = b.run.first;
  if (!corner || corner->dot(points.positions[p]) <= 0.0) return std::nullopt;
  for (; cross(points.positions[p], *corner) < 0.0; --p) {
    if (p == a.run.first || p + kMostTaken < a.run.last) return std::nullopt;
    if (!liesOn(b.fit, points.positions[p])) return std::nullopt;
  }
  for (; cross(*corner, points.positions[q]) < 0.0; ++q) {
    if (q + 1 == b.run.last || q >= b.run.first + kMostTaken) return std::nullopt;
    if (!liesOn(a.fit, points.positions[q])) return std::nullopt;
  }
  return corner;
}

}  // namespace

std::vector<LineSegment> polyLines(const ScanPoints& points, const RunFitter& fitter,
                                   const Runs& runs, const std::vector<std::vector<int>>& groups) {
  std::vector<int> line_of(runs.size(), -1);
  std::vector<FittedSegment> fits;
  std::vector<LineSegment> lines;
  fits.reserve(groups.size());
  lines.reserve(groups.size());
  for (const auto& group : groups) {
    PointMoments moments;
    for (const int k : group) {
      moments.add(runs[k].moments);
      line_of[k] = static_cast<int>(lines.size());
    }
    fits.push_back(group.size() == 1 ? FittedSegment(runs[group[0]]) : fitter.fit(moments));
    lines.push_back(
        segmentOf(points, fits.back(), runs[group.front()].first, runs[group.back()].last));
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::size_t next = (k + 1) % runs.size();
    if (next == 0 && !points.closed) break;
    const int a = line_of[k], b = line_of[next];
    if (a < 0 || b < 0 || a == b) continue;
    const int p = runs[k].last - 1, q = runs[next].first;
    if (groups[a].back() != static_cast<int>(k) || groups[b].front() != static_cast<int>(next)) {
      continue;
    }
    if (next != 0 ? points.silentBetween(p, q) > 0 : points.silentAtSeam() > 0) continue;
    const auto corner = cornerBetween(points, {fits[a], runs[k]}, {fits[b], runs[next]});
    if (corner) lines[a].end = lines[b].start = *corner;
  }
  return lines;
}

}  // namespace cca
