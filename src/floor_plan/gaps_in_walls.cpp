// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "floor_plan/passages.hpp"
#include "floor_plan/walls.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kStep = 0.25;  // cells: a ray misses no more than the corner of one
// m; a line of no more than a wall's thickness may be the end of one, and lead nowhere.
constexpr double kWall = PlanWallTuning{}.thickest;

/// Follows a ray from inside a wall's end over open cells to the next solid one.
std::optional<Passage> openStretch(const Mask& solid, const Eigen::Vector2d& from,
                                   const Eigen::Vector2d& direction, const PassageTuning& tuning) {
  const double step = kStep * solid.resolution;
  const auto isSolid = [&](double s) {
    return solid.at(solid.cellOf(from + s * direction), 1) != 0;
  };
  double begin = -0.5 * tuning.end_error;
  while (begin < tuning.end_error && isSolid(begin)) begin += step;
  if (isSolid(begin)) return std::nullopt;
  double end = begin;
  while (end - begin <= tuning.widest + step && !isSolid(end)) end += step;
  if (end - begin < tuning.narrowest || end - begin > tuning.widest) return std::nullopt;
  return Passage{from + begin * direction, from + end * direction, PassageEvidence::kAbutting};
}

/// Whether a line begins about where the gap ends, and goes on as the first one did.
bool goesOn(const Passage& gap, const Eigen::Vector2d& direction, const std::vector<MapLine>& lines,
            const PassageTuning& tuning) {
  return std::any_of(lines.begin(), lines.end(), [&](const MapLine& line) {
    const LineSegment& s = line.segment;
    if (s.length() < tuning.shortest_wall) return false;
    if (std::abs(s.direction().dot(direction)) < kCosOneWall) return false;
    const Eigen::Vector2d start = s.start - gap.b, end = s.end - gap.b;
    const double nearest = std::min(start.dot(direction), end.dot(direction));
    const double sideways =
        std::min(std::abs(cross(direction, start)), std::abs(cross(direction, end)));
    return std::abs(nearest) < tuning.end_error && sideways < tuning.sideways;
  });
}

}  // namespace

std::vector<Passage> gapsInWalls(const Mask& solid, const std::vector<MapLine>& lines,
                                 const PassageTuning& tuning) {
  std::vector<Passage> gaps;
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    if (s.length() < tuning.shortest_wall) continue;
    const Eigen::Vector2d along = s.direction(), into_wall(along.y(), -along.x());
    for (const bool at_end : {false, true}) {
      const Eigen::Vector2d direction = at_end ? along : Eigen::Vector2d(-along);
      const Eigen::Vector2d from = (at_end ? s.end : s.start) + tuning.depth * into_wall;
      auto gap = openStretch(solid, from, direction, tuning);
      if (!gap) continue;
      if (goesOn(*gap, direction, lines, tuning))
        gap->evidence = PassageEvidence::kCollinear;
      else if (s.length() < kWall)
        continue;
      gaps.push_back(*gap);
    }
  }
  return gaps;
}

std::vector<Passage> joinPassages(std::vector<Passage> gaps, const std::vector<Passage>& narrow,
                                  const PassageTuning& tuning) {
  gaps.insert(gaps.end(), narrow.begin(), narrow.end());
  // The best evidence first, the narrowest first among equals.
  std::stable_sort(gaps.begin(), gaps.end(), [](const Passage& p, const Passage& q) {
    if (p.evidence != q.evidence) return p.evidence > q.evidence;
    return p.width() < q.width();
  });
  std::vector<Passage> kept;
  for (const Passage& gap : gaps) {
    if (gap.width() < tuning.narrowest) continue;  // it may be, in the middle of the wall
    const Eigen::Vector2d way = (gap.b - gap.a).normalized();
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const Passage& other) {
      const Eigen::Vector2d other_way = (other.b - other.a).normalized();
      if (std::abs(way.dot(other_way)) < 0.8) return false;
      const Eigen::Vector2d off = gap.middle() - other.middle();
      const double sideways = std::abs(cross(other_way, off)), along = std::abs(other_way.dot(off));
      return sideways < tuning.merge_within && along < 0.5 * std::max(gap.width(), other.width());
    });
    if (!is_known) kept.push_back(gap);
  }
  return kept;
}

}  // namespace cca
