// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "floor_plan/passages.hpp"

namespace cca {
namespace {

constexpr double kTowards = 0.6;  // cosine: walls that meet at a right angle have .71 each
// Cosines: walls that lead one way to 18 degrees, and end side by side to 17 of square.
constexpr double kAlike = 0.95, kAside = 0.3;

/// Whether a segment crosses open cells only, but for `ends` metres at both its ends.
bool isClear(const Mask& solid, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double ends) {
  const double length = (b - a).norm(), step = 0.5 * solid.resolution;
  for (double s = ends; s < length - ends; s += step) {
    if (solid.at(solid.cellOf(a + s / length * (b - a)), 1)) return false;
  }
  return true;
}

/// m, how far one can go from a point before the next wall, at most `limit`.
double reach(const Mask& solid, const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
             double limit) {
  const double step = 0.5 * solid.resolution;
  double s = 0.0;
  while (s < limit && !solid.at(solid.cellOf(from + s * direction), 1)) s += step;
  return s;
}

/// Whether two walls end as the jambs of one opening do: towards each other, or side by side at one
/// front.
bool areJambs(const WallEnd& a, const WallEnd& b) {
  const Eigen::Vector2d way = (b.point - a.point).normalized();
  const double out_a = a.direction.dot(way), out_b = -b.direction.dot(way);
  if (out_a > kTowards && out_b > kTowards) return true;
  return a.direction.dot(b.direction) > kAlike && std::abs(out_a) < kAside;
}

}  // namespace

std::vector<Passage> gapsBetweenEnds(const Mask& solid, const std::vector<WallEnd>& ends,
                                     const PassageTuning& tuning) {
  std::vector<Passage> gaps;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const Passage gap{ends[i].point, ends[j].point, PassageEvidence::kBetweenEnds};
      if (gap.width() < tuning.narrowest || gap.width() > tuning.widest) continue;
      if (!areJambs(ends[i], ends[j])) continue;
      if (isClear(solid, gap.a, gap.b, tuning.end_error)) gaps.push_back(gap);
    }
  }
  return gaps;
}

Passage centred(const Mask& solid, const Passage& passage, const PassageTuning& tuning) {
  const Eigen::Vector2d way = (passage.b - passage.a).normalized(), across(-way.y(), way.x());
  const double wider = passage.width() + 3.0 * solid.resolution;
  const double step = 0.5 * solid.resolution;
  double stretch[2] = {0.0, 0.0};
  for (const int side : {0, 1}) {
    const Eigen::Vector2d onwards = side ? Eigen::Vector2d(-across) : across;
    for (double& s = stretch[side]; s < tuning.deepest; s += step) {
      const Eigen::Vector2d p = passage.middle() + s * onwards;
      const double width = reach(solid, p, way, wider) + reach(solid, p, -way, wider);
      if (width > wider) break;
    }
  }
  if (stretch[0] + stretch[1] >= tuning.deepest) return passage;
  const Eigen::Vector2d shift = 0.5 * (stretch[0] - stretch[1]) * across;
  const Eigen::Vector2d middle = passage.middle() + shift;
  Passage moved = passage;
  moved.a = middle - reach(solid, middle, -way, wider) * way;
  moved.b = middle + reach(solid, middle, way, wider) * way;
  return moved.width() > 0.5 * passage.width() && moved.width() < wider ? moved : passage;
}

}  // namespace cca
