// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/inliers.hpp"

#include <algorithm>
#include <cmath>

namespace cca::baselines {
namespace {

std::vector<std::size_t> near(const Pool& pool, const FittedLine& line, double distance) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < pool.points.size(); ++i) {
    if (!pool.taken[i] && distanceFrom(line, pool.points[i]) <= distance) found.push_back(i);
  }
  return found;
}

FittedLine fitTo(const Pool& pool, const std::vector<std::size_t>& indices) {
  PointMoments moments;
  for (std::size_t i : indices) moments.add(pool.points[i]);
  return fitLine(moments);
}

}  // namespace

std::vector<std::size_t> Pool::left() const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!taken[i]) indices.push_back(i);
  }
  return indices;
}

std::vector<Points> takePieces(Pool& pool, const FittedLine& candidate, const InlierParameters& p) {
  std::vector<std::size_t> members = near(pool, candidate, p.distance);
  if (members.size() < 2) return {};
  const FittedLine line = fitTo(pool, members);
  members = near(pool, line, p.distance);
  const auto along = [&](std::size_t i) {
    return line.direction.dot(pool.points[i] - line.centroid);
  };
  std::sort(members.begin(), members.end(),
            [&](std::size_t a, std::size_t b) { return along(a) < along(b); });

  std::vector<Points> pieces;
  for (std::size_t first = 0, last = 1; first < members.size(); first = last++) {
    while (last < members.size() && along(members[last]) - along(members[last - 1]) <= p.max_gap) {
      ++last;
    }
    if (last - first < 2) continue;
    Points piece;
    for (std::size_t k = first; k < last; ++k) piece.push_back(pool.points[members[k]]);
    if (!isLongEnough(segmentThrough(piece), piece.size(), p.limits)) continue;
    pieces.push_back(std::move(piece));
    for (std::size_t k = first; k < last; ++k) pool.taken[members[k]] = true;
  }
  return pieces;
}

std::vector<LineSegment> segmentsOf(const std::vector<Points>& pieces) {
  std::vector<LineSegment> segments;
  for (const Points& piece : pieces) segments.push_back(segmentThrough(piece));
  sortByBearing(segments);
  return segments;
}

void sortByBearing(std::vector<LineSegment>& segments) {
  const auto bearing = [](const LineSegment& s) {
    return std::atan2(s.moments.mean.y(), s.moments.mean.x());
  };
  std::stable_sort(
      segments.begin(), segments.end(),
      [&](const LineSegment& a, const LineSegment& b) { return bearing(a) < bearing(b); });
}

}  // namespace cca::baselines
