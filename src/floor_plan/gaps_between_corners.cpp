// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "cca_mrpt/floor_plan/passages.hpp"
#include "cca_mrpt/geometry/cross.hpp"
#include "clear_way.hpp"

namespace cca {
namespace {

constexpr double kTurn = 0.5;   // sine: two faces that turn away by 30 degrees make a corner
constexpr double kMeet = 0.15;  // m between the ends of two faces that meet
constexpr double kFace = 0.6;   // m; shorter lines are no faces of a corner of the building

/// The corners that stick out into open space: two long faces meet, and turn away from each other.
std::vector<Eigen::Vector2d> outerCorners(const std::vector<MapLine>& lines) {
  std::vector<Eigen::Vector2d> corners;
  for (const MapLine& one : lines) {
    const LineSegment& a = one.segment;
    if (a.length() < kFace) continue;
    for (const MapLine& other : lines) {
      const LineSegment& b = other.segment;
      // The viewer is on the left of both: faces that turn right leave more than half the plane
      // open.
      if (b.length() < kFace || (b.start - a.end).norm() > kMeet) continue;
      if (cross(a.direction(), b.direction()) < -kTurn) corners.push_back(0.5 * (a.end + b.start));
    }
  }
  return corners;
}

}  // namespace

std::vector<Passage> gapsBetweenCorners(const Mask& solid, const std::vector<MapLine>& lines,
                                        const PassageTuning& tuning) {
  const std::vector<Eigen::Vector2d> corners = outerCorners(lines);
  std::vector<Passage> gaps;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      const Passage gap{corners[i], corners[j], PassageEvidence::kBetweenCorners};
      if (gap.width() < tuning.narrowest || gap.width() > tuning.widest) continue;
      if (isClear(solid, gap.a, gap.b, tuning.corner_cells * solid.resolution)) gaps.push_back(gap);
    }
  }
  return gaps;
}

}  // namespace cca
