// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/floor_plan/jambs.hpp"

#include <cmath>

#include "cca_mrpt/geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kAcross = 0.5, kAlong = 0.9;  // cosines of the angle to the passage

/// m, the mean of numbers that were added; 0 of none.
struct Mean {
  double sum = 0.0;
  int count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  double value() const { return count ? sum / count : 0.0; }
};

/// m, along `way` from a jamb to where the lines have it. Lines across the passage decide if any.
double shiftOfJamb(const Eigen::Vector2d& jamb, const Eigen::Vector2d& way,
                   const std::vector<MapLine>& lines, const JambTuning& tuning) {
  Mean across, ends;
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    const Eigen::Vector2d direction = s.direction(), off = s.start - jamb;
    if (std::abs(direction.dot(way)) < kAcross) {
      const double sine = cross(way, direction);
      const double along = cross(off, direction) / sine, at = cross(off, way) / sine;
      if (std::abs(along) < tuning.search && at > -tuning.search && at < s.length() + tuning.search)
        across.add(along);
      continue;
    }
    if (std::abs(direction.dot(way)) < kAlong) continue;
    for (const Eigen::Vector2d& end : {s.start, s.end}) {
      const double along = (end - jamb).dot(way);
      if (std::abs(along) < tuning.search &&
          std::abs(cross(way, Eigen::Vector2d(end - jamb))) < tuning.sideways)
        ends.add(along);
    }
  }
  return across.count ? across.value() : ends.value();
}

}  // namespace

Passage withJambsOfLines(const Passage& passage, const std::vector<MapLine>& lines,
                         const JambTuning& tuning) {
  if (passage.width() <= 2.0 * tuning.search) return passage;
  const Eigen::Vector2d way = (passage.b - passage.a).normalized();
  Passage moved = passage;
  moved.a += shiftOfJamb(passage.a, way, lines, tuning) * way;
  moved.b += shiftOfJamb(passage.b, way, lines, tuning) * way;
  return moved;
}

}  // namespace cca
