// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "cca_mrpt/geometry/pose2.hpp"
#include "floor_plan/walls.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

/// Stretches along a line, from its start [m].
struct FacePart {
  double begin = 0.0, end = 0.0;
  double length() const { return end - begin; }
};

/// What no wall has taken yet of a line.
class FreeParts {
 public:
  explicit FreeParts(double length) : free_{{0.0, length}} {}
  const std::vector<FacePart>& all() const { return free_; }
  void take(const FacePart& taken) {
    std::vector<FacePart> left;
    for (const FacePart& s : free_) {
      if (taken.begin > s.begin) left.push_back({s.begin, std::min(s.end, taken.begin)});
      if (taken.end < s.end) left.push_back({std::max(s.begin, taken.end), s.end});
    }
    left.erase(std::remove_if(left.begin(), left.end(),
                              [](const FacePart& s) { return s.length() <= 0.0; }),
               left.end());
    free_.swap(left);
  }

 private:
  std::vector<FacePart> free_;
};

struct FacePair {
  std::size_t one, other;
  FacePart common;  ///< along the first
  double thickness;
};

/// A stretch of one line, seen along the other, which runs the other way.
FacePart seenAlong(const LineSegment& from, const LineSegment& to, const FacePart& stretch) {
  const Eigen::Vector2d direction = to.direction();
  const auto along = [&](double s) {
    return (from.start + s * from.direction() - to.start).dot(direction);
  };
  return {along(stretch.end), along(stretch.begin)};
}

bool isSolidBetween(const Mask& solid, const Eigen::Vector2d& middle) {
  return solid.at(solid.cellOf(middle), 1) != 0;
}

std::vector<FacePair> facePairs(const Mask& solid, const std::vector<MapLine>& lines,
                                const PlanWallTuning& tuning) {
  const double cosine = std::cos(tuning.parallel_deg * kRadiansPerDegree);
  std::vector<FacePair> pairs;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const LineSegment& a = lines[i].segment;
    const Eigen::Vector2d along = a.direction(), into_wall(along.y(), -along.x());
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const LineSegment& b = lines[j].segment;
      if (along.dot(b.direction()) > -cosine) continue;
      const double b0 = (b.end - a.start).dot(along), b1 = (b.start - a.start).dot(along);
      const FacePart common{std::max(0.0, b0), std::min(a.length(), b1)};
      if (common.length() < tuning.shortest) continue;
      const double middle = 0.5 * (common.begin + common.end);
      const Eigen::Vector2d p = a.start + middle * along;
      const double thickness =
          -cross(b.direction(), Eigen::Vector2d(p - b.start)) / std::abs(along.dot(b.direction()));
      if (thickness < tuning.thinnest || thickness > tuning.thickest) continue;
      if (!isSolidBetween(solid, p + 0.5 * thickness * into_wall)) continue;
      pairs.push_back({i, j, common, thickness});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const FacePair& p, const FacePair& q) { return p.thickness < q.thickness; });
  return pairs;
}

/// The centre line between a stretch of one face and the other face.
PlanWall wallBetween(const MapLine& one, const MapLine& other, const FacePart& stretch) {
  const LineSegment &a = one.segment, &b = other.segment;
  const Eigen::Vector2d along = a.direction(), into_wall(along.y(), -along.x());
  PlanWall wall;
  const auto thicknessAt = [&](const Eigen::Vector2d& p) {
    return std::max(0.0, -cross(b.direction(), Eigen::Vector2d(p - b.start)));
  };
  const Eigen::Vector2d start = a.start + stretch.begin * along,
                        end = a.start + stretch.end * along;
  wall.start = start + 0.5 * thicknessAt(start) * into_wall;
  wall.end = end + 0.5 * thicknessAt(end) * into_wall;
  wall.thickness = 0.5 * (thicknessAt(start) + thicknessAt(end));
  wall.left = {one.id};
  wall.right = {other.id};
  return wall;
}

}  // namespace

std::vector<PlanWall> wallsOfLines(const Mask& solid, const std::vector<MapLine>& lines,
                                   const PlanWallTuning& tuning) {
  std::vector<FreeParts> left;
  for (const MapLine& line : lines) left.emplace_back(line.segment.length());
  std::vector<PlanWall> walls;
  for (const FacePair& pair : facePairs(solid, lines, tuning)) {
    const LineSegment &a = lines[pair.one].segment, &b = lines[pair.other].segment;
    const std::vector<FacePart> mine = left[pair.one].all(), theirs = left[pair.other].all();
    for (const FacePart& s : mine) {
      for (const FacePart& t : theirs) {
        const FacePart back = seenAlong(b, a, t);
        const FacePart common{std::max({s.begin, back.begin, pair.common.begin}),
                              std::min({s.end, back.end, pair.common.end})};
        if (common.length() < tuning.shortest) continue;
        walls.push_back(wallBetween(lines[pair.one], lines[pair.other], common));
        left[pair.one].take(common);
        left[pair.other].take(seenAlong(a, b, common));
      }
    }
  }
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const LineSegment& s = lines[k].segment;
    for (const FacePart& stretch : left[k].all()) {
      if (stretch.length() < tuning.shortest_face) continue;
      PlanWall wall;
      wall.start = s.start + stretch.begin * s.direction();
      wall.end = s.start + stretch.end * s.direction();
      wall.left = {lines[k].id};
      walls.push_back(wall);
    }
  }
  for (std::size_t k = 0; k < walls.size(); ++k) walls[k].id = static_cast<int>(k) + 1;
  return walls;
}

}  // namespace cca
