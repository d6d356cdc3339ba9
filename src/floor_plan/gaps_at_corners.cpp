// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "floor_plan/passages.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr double kTurn = 0.5;    // sine: two faces that turn away by 30 degrees make a corner
constexpr double kOn = 0.15;     // m from a line; nearer is on it
constexpr double kFace = 0.8;    // m; faces of a corner of the building are that long
constexpr double kBeside = 0.1;  // m to both sides of a face: past the cells that its noise fills
constexpr double kFacing = 0.9;  // cosine: faces of a corridor are parallel to 25 degrees

/// A corner that sticks out into open space: two long faces meet, and turn away from each other.
struct Corner {
  Eigen::Vector2d point, before, after;  ///< m, and the directions of both faces
};

/// Whether a face goes on straight from a point, be it in one line or in several: solid behind,
/// open in front. @param to_viewer  unit.
bool isFace(const Mask& solid, const Eigen::Vector2d& from, const Eigen::Vector2d& along,
            const Eigen::Vector2d& to_viewer, const PassageTuning& tuning) {
  for (double s = tuning.end_error; s <= kFace; s += solid.resolution) {
    const Eigen::Vector2d p = from + s * along;
    if (!solid.at(solid.cellOf(p - kBeside * to_viewer), 1)) return false;
    if (solid.at(solid.cellOf(p + 1.5 * kBeside * to_viewer), 1)) return false;
  }
  return true;
}

/// Where two lines cross, if both end near there: lines end before their walls do.
std::optional<Eigen::Vector2d> meetingOf(const LineSegment& a, const LineSegment& b,
                                         const PassageTuning& tuning) {
  const Eigen::Vector2d before = a.direction(), after = b.direction();
  // The viewer is on the left of both: faces that turn right leave more than half the plane open.
  const double turn = cross(before, after);
  if (turn > -kTurn) return std::nullopt;
  const Eigen::Vector2d off = b.start - a.end;
  const double beyond_a = cross(off, after) / turn, beyond_b = cross(off, before) / turn;
  if (std::abs(beyond_a) > tuning.end_error || std::abs(beyond_b) > tuning.end_error)
    return std::nullopt;
  return a.end + beyond_a * before;
}

std::vector<Corner> outerCorners(const Mask& solid, const std::vector<MapLine>& lines,
                                 const PassageTuning& tuning) {
  std::vector<Corner> corners;
  for (const MapLine& one : lines) {
    const LineSegment& a = one.segment;
    if (a.length() < tuning.shortest_wall) continue;
    for (const MapLine& other : lines) {
      const LineSegment& b = other.segment;
      if (b.length() < tuning.shortest_wall) continue;
      if (std::abs(b.start.x() - a.end.x()) > 2.0 * tuning.end_error) continue;
      const auto point = meetingOf(a, b, tuning);
      if (!point) continue;
      const Eigen::Vector2d before = a.direction(), after = b.direction();
      const Eigen::Vector2d inside = *point + kBeside * (after - before);
      if (!solid.at(solid.cellOf(inside), 1)) continue;
      if (isFace(solid, *point, -before, {-before.y(), before.x()}, tuning) &&
          isFace(solid, *point, after, {-after.y(), after.x()}, tuning))
        corners.push_back({*point, before, after});
    }
  }
  return corners;
}

/// The way from a corner straight off one of its faces to the next wall, where that faces it.
std::optional<Passage> acrossFrom(const Mask& solid, const Eigen::Vector2d& corner,
                                  const Eigen::Vector2d& face, const std::vector<MapLine>& lines,
                                  const PassageTuning& tuning) {
  const Eigen::Vector2d across(-face.y(), face.x());
  const double step = 0.5 * solid.resolution;
  double s = tuning.corner_cells * solid.resolution;
  while (s <= tuning.widest && !solid.at(solid.cellOf(corner + s * across), 1)) s += step;
  if (s < tuning.narrowest || s > tuning.widest) return std::nullopt;
  const Passage gap{corner, corner + s * across, PassageEvidence::kAtCorner};
  const bool is_faced = std::any_of(lines.begin(), lines.end(), [&](const MapLine& line) {
    const LineSegment& other = line.segment;
    if (other.length() < tuning.shortest_wall || other.direction().dot(face) > -kFacing)
      return false;
    const double along = (gap.b - other.start).dot(other.direction());
    return along > -kOn && along < other.length() + kOn &&
           std::abs(cross(other.direction(), Eigen::Vector2d(gap.b - other.start))) < kOn;
  });
  if (!is_faced) return std::nullopt;
  return gap;
}

}  // namespace

std::vector<Passage> gapsAtCorners(const Mask& solid, const std::vector<MapLine>& lines,
                                   const PassageTuning& tuning) {
  std::vector<Passage> gaps;
  for (const Corner& corner : outerCorners(solid, lines, tuning)) {
    for (const Eigen::Vector2d& face : {corner.before, corner.after}) {
      if (const auto gap = acrossFrom(solid, corner.point, face, lines, tuning))
        gaps.push_back(*gap);
    }
  }
  return gaps;
}

}  // namespace cca
