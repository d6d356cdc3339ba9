// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/poly_lines.hpp"

#include <cmath>

namespace cca {
namespace {

/// sin 3 deg: directions nearer than this do not fix where two lines, or line and beam, meet.
constexpr double kAlongTheLine = 0.05;
/// A corner may lie this many beams outside of the gap between the two that see it.
constexpr double kCornerBeams = 1.0;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

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

/// The corner of two lines, if it lies between beam p, the last of a, and q, the first of b.
bool cornerBetween(const FittedLine& a, const FittedLine& b, const Eigen::Vector2d& p,
                   const Eigen::Vector2d& q, double beam_spacing, Eigen::Vector2d* corner) {
  const double sine = cross(a.direction, b.direction);
  if (std::abs(sine) < kAlongTheLine) return false;
  *corner = a.centroid + a.direction * (cross(b.centroid - a.centroid, b.direction) / sine);
  const double slack = std::sin(kCornerBeams * beam_spacing) * corner->norm();
  return corner->dot(p) > 0.0 && cross(p, *corner) > -slack * p.norm() &&
         cross(*corner, q) > -slack * q.norm();
}

}  // namespace

std::vector<LineSegment> polyLines(const ScanPoints& points, const RunFitter& fitter,
                                   const Runs& runs, const std::vector<std::vector<int>>& groups) {
  std::vector<int> line_of(runs.size(), -1);
  std::vector<FittedSegment> fits;
  std::vector<LineSegment> lines;
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
    Eigen::Vector2d corner;
    if (cornerBetween(fits[a].line, fits[b].line, points.positions[p], points.positions[q],
                      points.beam_spacing, &corner)) {
      lines[a].end = lines[b].start = corner;
    }
  }
  return lines;
}

}  // namespace cca
