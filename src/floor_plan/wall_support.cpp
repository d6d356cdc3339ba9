// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "floor_plan/passages.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

/// m of wall that leads up to a jamb from beyond, in the line of the passage: it ends there, as
/// well as lines have their ends. A wall goes on beyond its doors.
double wallBeyond(const Eigen::Vector2d& jamb, const Eigen::Vector2d& outwards,
                  const std::vector<MapLine>& lines, const PassageTuning& tuning) {
  std::vector<std::pair<double, double>> pieces;  // m from the jamb: begin, end
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    if (std::abs(s.direction().dot(outwards)) < kCosOneWall) continue;
    const Eigen::Vector2d start = s.start - jamb, end = s.end - jamb;
    if (std::min(std::abs(cross(outwards, start)), std::abs(cross(outwards, end))) >
        tuning.sideways)
      continue;
    const auto [near, far] = std::minmax({start.dot(outwards), end.dot(outwards)});
    if (far > 0.0) pieces.emplace_back(std::max(near, 0.0), far);
  }
  std::sort(pieces.begin(), pieces.end());
  double length = 0.0, reached = 0.0;
  for (const auto& [begin, end] : pieces) {
    if (begin > reached + (length > 0.0 ? tuning.widest_door : tuning.end_error)) break;
    length += std::max(0.0, end - std::max(begin, reached));
    reached = std::max(reached, end);
  }
  return length;
}

}  // namespace

double wallSupport(const Passage& passage, const std::vector<MapLine>& lines,
                   const PassageTuning& tuning) {
  const Eigen::Vector2d way = (passage.b - passage.a).normalized();
  const double wall =
      wallBeyond(passage.a, -way, lines, tuning) + wallBeyond(passage.b, way, lines, tuning);
  return wall / (wall + passage.width());
}

}  // namespace cca
