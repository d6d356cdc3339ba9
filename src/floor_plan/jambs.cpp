// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/jambs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kAcross = 0.5, kAlong = 0.9;  // cosines of the angle to the passage
// Ends of lines lie up to the spacing of the beams short of the wall's, or the noise of a grazing
// beam beyond; cells are off by up to half a cell, independently: the mean is better than either.
constexpr double kShareOfEnds = 0.5;

/// m, along `inwards` (into the passage) from a jamb to where the lines have it. Lines across the
/// passage decide if any: the one that reaches farthest in, as of the ends.
double shiftOfJamb(const Eigen::Vector2d& jamb, const Eigen::Vector2d& inwards,
                   const std::vector<MapLine>& lines, const JambTuning& tuning) {
  std::optional<double> across, ends;
  const auto extend = [](std::optional<double>& farthest, double along) {
    farthest = farthest ? std::max(*farthest, along) : along;
  };
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    const Eigen::Vector2d direction = s.direction(), off = s.start - jamb;
    if (std::abs(direction.dot(inwards)) < kAcross) {
      const double sine = cross(inwards, direction);
      const double along = cross(off, direction) / sine, at = cross(off, inwards) / sine;
      if (std::abs(along) < tuning.search && at > -tuning.search && at < s.length() + tuning.search)
        extend(across, along);
      continue;
    }
    if (std::abs(direction.dot(inwards)) < kAlong) continue;
    for (const Eigen::Vector2d& end : {s.start, s.end}) {
      const double along = (end - jamb).dot(inwards);
      if (std::abs(along) < tuning.search &&
          std::abs(cross(inwards, Eigen::Vector2d(end - jamb))) < tuning.sideways)
        extend(ends, along);
    }
  }
  return across ? *across : kShareOfEnds * ends.value_or(0.0);
}

}  // namespace

Passage withJambsOfLines(const Passage& passage, const std::vector<MapLine>& lines,
                         const JambTuning& tuning) {
  if (passage.width() <= 2.0 * tuning.search) return passage;
  const Eigen::Vector2d way = (passage.b - passage.a).normalized();
  Passage moved = passage;
  moved.a += shiftOfJamb(passage.a, way, lines, tuning) * way;
  moved.b -= shiftOfJamb(passage.b, -way, lines, tuning) * way;
  return moved;
}

}  // namespace cca
