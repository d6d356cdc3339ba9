// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "geometry/cross.hpp"
#include "mapping/support_profile.hpp"
#include "mapping/wall_index.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

constexpr double kLeastSine = 0.2;  // flatter intersections are fixed by noise
constexpr double kMostCut = 0.5;    // of a line that a corner, or what it meets, may take away

using End = Corner::End;

Eigen::Vector2d& pointOf(std::vector<MapLine>& lines, const End& end) {
  LineSegment& s = lines[end.line].segment;
  return end.last ? s.end : s.start;
}

struct CornerCandidate {
  double moved;  // m, by both ends together
  End a, b;
  Eigen::Vector2d vertex;
};

/// Where two lines meet near these ends; false where they do not.
bool meet(const std::vector<MapLine>& lines, const End& a, const End& b, double reach,
          CornerCandidate* corner) {
  const LineSegment &s = lines[a.line].segment, &t = lines[b.line].segment;
  const Eigen::Vector2d u = s.direction(), v = t.direction();
  const double sine = cross(u, v);
  if (std::abs(sine) < kLeastSine) return false;
  const Eigen::Vector2d p = a.last ? s.end : s.start, q = b.last ? t.end : t.start, w = q - p;
  const double along_a = cross(w, v) / sine;
  const double along_b = cross(w, u) / sine;
  if (std::abs(along_a) > reach || std::abs(along_b) > reach) return false;
  const double cut_a = a.last ? -along_a : along_a, cut_b = b.last ? -along_b : along_b;
  if (cut_a > kMostCut * s.length() || cut_b > kMostCut * t.length()) return false;
  *corner = {std::abs(along_a) + std::abs(along_b), a, b, p + along_a * u};
  return true;
}

/// How far, m, the end `p` of a line that goes on from there to `inwards` lies beyond another line,
/// which reaches so far or lacks `lack`, m, at most; 0 where it does not.
double overshoot(const Eigen::Vector2d& p, const Eigen::Vector2d& inwards, const LineSegment& wall,
                 double lack) {
  const Eigen::Vector2d along = wall.direction();
  const double sine = cross(along, inwards);
  if (std::abs(sine) < kLeastSine) return 0.0;
  const double beyond = cross(along, wall.start - p) / sine, length = wall.length();
  const double at = along.dot(p + beyond * inwards - wall.start);
  return at > -lack && at < length + lack && beyond < length ? beyond : 0.0;
}

std::size_t numberOf(const End& end) { return 2 * end.line + (end.last ? 1 : 0); }

/// The ends of all lines by cells of 2 x reach, so that partners are in touching cells.
class EndGrid {
 public:
  EndGrid(std::vector<MapLine>& lines, double reach) : size_(2.0 * reach) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (const bool last : {false, true})
        cells_[cellOf(pointOf(lines, {i, last}))].push_back({i, last});
    }
  }
  template <class Visit>
  void near(const Eigen::Vector2d& p, Visit&& visit) const {
    const auto [x, y] = cellOf(p);
    for (long dy = -1; dy <= 1; ++dy) {
      for (long dx = -1; dx <= 1; ++dx) {
        const auto cell = cells_.find({x + dx, y + dy});
        if (cell == cells_.end()) continue;
        for (const End& end : cell->second) visit(end);
      }
    }
  }

 private:
  std::pair<long, long> cellOf(const Eigen::Vector2d& p) const {
    return {std::lround(std::floor(p.x() / size_)), std::lround(std::floor(p.y() / size_))};
  }
  double size_;
  std::map<std::pair<long, long>, std::vector<End>> cells_;
};

}  // namespace

void cutOvershoots(std::vector<MapLine>& lines, double scatter) {
  WallIndex index;
  std::vector<WallIndex::Cell> cells;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const LineSegment& s = lines[k].segment;
    cells.clear();
    index.insert(static_cast<WallIndex::Slot>(k), s.start, s.end, scatter, cells);
  }
  const double lack = std::max(SupportProfile::kResolved, scatter);
  std::vector<LineSegment> whole;
  for (const MapLine& line : lines) whole.push_back(line.segment);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double longest = std::min(scatter, kMostCut * whole[k].length());
    for (const bool last : {false, true}) {
      Eigen::Vector2d& p = pointOf(lines, {k, last});
      const Eigen::Vector2d inwards = (last ? -1.0 : 1.0) * whole[k].direction();
      double cut = 0.0;
      for (const WallIndex::Slot other : index.at(WallIndex::cellOf(p))) {
        const double beyond = overshoot(p, inwards, whole[static_cast<std::size_t>(other)], lack);
        if (beyond < longest) cut = std::max(cut, beyond);
      }
      p += cut * inwards;
    }
  }
}

std::vector<Corner> joinCorners(std::vector<MapLine>& lines, double reach) {
  const EndGrid grid(lines, reach);
  std::vector<CornerCandidate> candidates;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const bool last : {false, true}) {
      const End a{i, last};
      grid.near(pointOf(lines, a), [&](const End& b) {
        CornerCandidate corner;
        if (b.line > i && meet(lines, a, b, reach, &corner)) candidates.push_back(corner);
      });
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const CornerCandidate& x, const CornerCandidate& y) {
              return std::make_tuple(x.moved, numberOf(x.a), numberOf(x.b)) <
                     std::make_tuple(y.moved, numberOf(y.a), numberOf(y.b));
            });
  std::vector<bool> taken(2 * lines.size(), false);
  std::vector<Corner> corners;
  for (const CornerCandidate& c : candidates) {
    if (taken[numberOf(c.a)] || taken[numberOf(c.b)]) continue;
    taken[numberOf(c.a)] = taken[numberOf(c.b)] = true;
    pointOf(lines, c.a) = pointOf(lines, c.b) = c.vertex;
    corners.push_back({c.a, c.b});
  }
  return corners;
}

std::vector<PolyLine> chainLines(const std::vector<MapLine>& lines,
                                 const std::vector<Corner>& corners) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> partner(2 * lines.size(), kNone);
  for (const Corner& c : corners) {
    partner[numberOf(c.a)] = numberOf(c.b);
    partner[numberOf(c.b)] = numberOf(c.a);
  }
  const auto point = [&](std::size_t end) {
    const LineSegment& s = lines[end / 2].segment;
    return end % 2 == 1 ? s.end : s.start;
  };
  std::vector<bool> used(lines.size(), false);
  std::vector<PolyLine> chains;
  const auto follow = [&](std::size_t entry) {
    PolyLine chain;
    chain.vertices.push_back(point(entry));
    while (entry != kNone && !used[entry / 2]) {
      used[entry / 2] = true;
      chain.line_ids.push_back(lines[entry / 2].id);
      chain.vertices.push_back(point(entry ^ 1));
      entry = partner[entry ^ 1];
    }
    chains.push_back(std::move(chain));
  };
  for (std::size_t end = 0; end < partner.size(); ++end) {
    if (partner[end] == kNone && !used[end / 2]) follow(end);
  }
  for (std::size_t line = 0; line < lines.size(); ++line) {
    if (!used[line]) follow(2 * line);  // a ring: its last vertex is its first
  }
  return chains;
}

}  // namespace cca
