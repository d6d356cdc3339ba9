// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/point_set.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/mapping/cross.hpp"
#include "cca_mrpt/mapping/gates.hpp"
#include "cca_mrpt/mapping/planar_clusters.hpp"
#include "cca_mrpt/mapping/range_noise.hpp"
#include "cca_mrpt/mapping/rank_order_clustering.hpp"
#include "cca_mrpt/mapping/similarity.hpp"

namespace cca {
namespace {

constexpr double kOdds[] = {0.1, 0.4, 1.0};  // as for a scan, and the cut itself
constexpr int kReassignments = 3;

struct Interval {
  double low, high;
};

Interval extentAlong(const PlanarCluster& c, const FittedLine& line) {
  const double a = line.direction.dot(c.at(c.low) - line.centroid);
  const double b = line.direction.dot(c.at(c.high) - line.centroid);
  return {std::min(a, b), std::max(a, b)};
}

double similarityOf(const PlanarCluster& a, const PlanarCluster& b, double cut) {
  const double reach = std::max(a.reach, b.reach);
  const double apart = (a.fit.line.centroid - b.fit.line.centroid).norm();
  if (apart > a.high - a.low + b.high - b.low + 2.0 * reach) return 0.0;
  PointMoments moments = a.fit.moments;
  moments.add(b.fit.moments);
  const double variance =
      (a.fit.moments.weight * a.fit.variance + b.fit.moments.weight * b.fit.variance) /
      moments.weight;
  const FittedSegment joint = fitTo(moments, variance);
  if (fitMembership(a.fit, b.fit, joint) < cut) return 0.0;
  const Interval i = extentAlong(a, joint.line), j = extentAlong(b, joint.line);
  const double shared = std::min(i.high, j.high) - std::max(i.low, j.low);
  const double shorter = std::min(i.high - i.low, j.high - j.low);
  const double overlap = shared <= 0.0   ? 0.0
                         : shorter > 0.0 ? std::min(1.0, shared / shorter)
                                         : 1.0;
  // Missing points are counted from the longest step that a wall would show.
  const double missing = std::max(0.0, -shared - reach) / reach;
  return memberships(a.fit, b.fit, joint, missing, overlap).similarity();
}

bool mergeOnce(const std::vector<SpatialPoint>& points, double cut,
               std::vector<PlanarCluster>* all) {
  const int n = static_cast<int>(all->size());
  SimilarityMatrix s(n);
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      const double similarity = similarityOf((*all)[i], (*all)[j], cut);
      if (similarity >= cut) s.set(i, j, similarity);
    }
  }
  if (s.entries().empty()) return false;
  const std::vector<int> group_of = rankOrderGroups(s, cut);
  std::vector<std::vector<int>> members(all->size());
  for (int k = 0; k < n; ++k) {
    const std::vector<int>& own = (*all)[k].members;
    std::vector<int>& group = members[group_of[k]];
    group.insert(group.end(), own.begin(), own.end());
  }
  std::vector<PlanarCluster> merged;
  for (std::vector<int>& m : members) {
    if (!m.empty()) merged.push_back(planarCluster(points, std::move(m)));
  }
  all->swap(merged);
  return true;
}

/// The line on which a point lies best, of those that reach it: its index and the residual z^2.
struct Nearest {
  int line = -1;
  double z_sq = 2.0 * kPointPrice;  // farther, a point is told alone
};

Nearest nearestLine(const SpatialPoint& point, const std::vector<PlanarCluster>& lines,
                    int without) {
  Nearest best;
  for (int k = 0; k < static_cast<int>(lines.size()); ++k) {
    if (k == without) continue;
    const PlanarCluster& c = lines[k];
    const Eigen::Vector2d off = point.position - c.fit.line.centroid;
    const Eigen::Vector2d& u = c.fit.line.direction;
    const double along = u.dot(off), across = cross(u, off);
    const double margin = point.spacing + kNormalGate * point.sigma;
    if (along < c.low - margin || along > c.high + margin) continue;
    const double z_sq = across * across / (point.sigma * point.sigma);
    if (z_sq < best.z_sq) best = {k, z_sq};
  }
  return best;
}

/// Drops lines, the lightest first, whose points the others tell as briefly.
void dropExplained(const std::vector<SpatialPoint>& points, std::vector<PlanarCluster>* lines) {
  std::stable_sort(lines->begin(), lines->end(),
                   [](const PlanarCluster& a, const PlanarCluster& b) {
                     return a.members.size() > b.members.size();
                   });
  for (int k = static_cast<int>(lines->size()) - 1; k >= 0; --k) {
    const PlanarCluster& c = (*lines)[k];
    double told_by_others = 0.0;
    for (const int i : c.members) {
      told_by_others += 0.5 * nearestLine(points[i], *lines, k).z_sq;
      if (told_by_others > c.fit.price) break;
    }
    if (told_by_others <= c.fit.price) lines->erase(lines->begin() + k);
  }
}

/// Each point goes to its nearest line, and all are refitted.
void reassign(const std::vector<SpatialPoint>& points, std::vector<PlanarCluster>* lines) {
  std::vector<std::vector<int>> members(lines->size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const int line = nearestLine(points[p], *lines, -1).line;
    if (line >= 0) members[line].push_back(static_cast<int>(p));
  }
  std::vector<PlanarCluster> next;
  for (std::vector<int>& m : members) {
    if (m.size() >= kFewestPoints) next.push_back(planarCluster(points, std::move(m)));
  }
  lines->swap(next);
}

LineSegment segmentOf(const PlanarCluster& c) {
  LineSegment s;
  s.start = c.at(c.low);
  s.end = c.at(c.high);
  s.moments = c.fit.moments;
  s.covariance(0, 0) = c.fit.variance / c.fit.moments.weight;
  s.covariance(1, 1) = c.fit.variance / c.fit.line.spread_sum_sq;
  return s;
}

/// Pulls an end of each of two lines to their intersection, where both lie within reach of it.
void joinEnds(const PlanarCluster& a, const PlanarCluster& b, LineSegment* s, LineSegment* t) {
  const Eigen::Vector2d &u = a.fit.line.direction, &v = b.fit.line.direction;
  const double sine = cross(u, v);
  if (std::abs(sine) < std::sin(kGrazing)) return;
  const Eigen::Vector2d w = b.fit.line.centroid - a.fit.line.centroid;
  const Eigen::Vector2d corner = a.fit.line.centroid + u * (cross(w, v) / sine);
  const double deviation = std::sqrt(std::max(a.fit.variance, b.fit.variance));
  const double within = std::max(a.reach, b.reach) * std::sin(kGrazing) + kNormalGate * deviation;
  const auto nearEnd = [&](LineSegment* l) -> Eigen::Vector2d* {
    Eigen::Vector2d* end =
        (l->start - corner).norm() < (l->end - corner).norm() ? &l->start : &l->end;
    return (*end - corner).norm() <= within ? end : nullptr;
  };
  Eigen::Vector2d *p = nearEnd(s), *q = nearEnd(t);
  if (p && q) *p = *q = corner;
}

}  // namespace

void appendPoints(const Scan& scan, const Pose2& T_frame_sensor,
                  std::vector<SpatialPoint>* points) {
  const ScanPoints own = scanPoints(scan);
  const double sigma = std::max(rangeNoise(scan).range_sigma, kStraightness);
  for (const Eigen::Vector2d& p_sensor : own.positions) {
    points->push_back({T_frame_sensor * p_sensor, sigma, p_sensor.norm() * own.beam_spacing});
  }
}

std::vector<LineSegment> extractLines(const std::vector<SpatialPoint>& points,
                                      const CcaParameters& parameters) {
  std::vector<SpatialPoint> finite;
  for (const SpatialPoint& p : points) {
    if (p.position.allFinite() && p.sigma > 0.0 && p.spacing > 0.0) finite.push_back(p);
  }
  std::vector<PlanarCluster> lines = planarClusters(finite, parameters.points_per_cluster);
  for (const double share : kOdds) {
    const double cut = 1.0 / (1.0 + share * (1.0 / parameters.similarity_cut - 1.0));
    while (mergeOnce(finite, cut, &lines)) {
    }
  }
  const auto dropLoose = [&] {
    lines.erase(std::remove_if(lines.begin(), lines.end(),
                               [](const PlanarCluster& c) { return !c.fit.is_line; }),
                lines.end());
  };
  dropLoose();
  for (int k = 0; k < kReassignments; ++k) {
    dropExplained(finite, &lines);
    reassign(finite, &lines);
    while (mergeOnce(finite, parameters.similarity_cut, &lines)) {
    }
    dropLoose();
  }
  std::sort(lines.begin(), lines.end(), [](const PlanarCluster& a, const PlanarCluster& b) {
    const Eigen::Vector2d p = a.at(a.low), q = b.at(b.low);
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  });
  std::vector<LineSegment> segments;
  for (const PlanarCluster& c : lines) segments.push_back(segmentOf(c));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      joinEnds(lines[i], lines[j], &segments[i], &segments[j]);
    }
  }
  return segments;
}

}  // namespace cca
