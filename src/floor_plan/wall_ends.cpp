// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/wall_ends.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kAhead = 0.25;  // m; what lies that far before the end is open

}  // namespace

std::vector<WallEnd> freeWallEnds(const Mask& solid, const std::vector<MapLine>& lines,
                                  const WallEndTuning& tuning) {
  std::vector<WallEnd> ends;
  for (const MapLine& one : lines) {
    const LineSegment& a = one.segment;
    if (a.length() < tuning.shortest_face) continue;
    const Eigen::Vector2d along = a.direction();
    for (const MapLine& other : lines) {
      const LineSegment& b = other.segment;
      if (b.length() < tuning.shortest_face || along.dot(b.direction()) > -kCosOneWall) continue;
      // The wall lies on the right of both.
      const Eigen::Vector2d off = b.start - a.end;
      const double thickness = -cross(along, off);
      if (thickness < 0.0 || thickness > tuning.thickest) continue;
      if (std::abs(off.dot(along)) > tuning.uneven) continue;
      const WallEnd end{0.5 * (a.end + b.start), along, thickness};
      const Cell ahead = solid.cellOf(end.point + (0.5 * tuning.uneven + kAhead) * along);
      if (solid.at(ahead, 1) == 0) ends.push_back(end);
    }
  }
  return ends;
}

}  // namespace cca
