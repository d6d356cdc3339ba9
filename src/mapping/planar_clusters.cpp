// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/planar_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cca_mrpt/mapping/cross.hpp"
#include "cca_mrpt/mapping/gates.hpp"
#include "cca_mrpt/mapping/k_means.hpp"

namespace cca {

FittedSegment fitTo(const PointMoments& moments, double variance) {
  return {moments, fitLine(moments), {variance, variance}};
}

PlanarCluster planarCluster(const std::vector<SpatialPoint>& points, std::vector<int> members) {
  PlanarCluster c;
  c.members = std::move(members);
  PointMoments moments;
  double variance = 0.0;
  for (const int i : c.members) {
    moments.add(points[i].position);
    variance += points[i].sigma * points[i].sigma;
    c.reach = std::max(c.reach, points[i].spacing / std::sin(kGrazing));
  }
  c.fit = fitTo(moments, variance / moments.weight);
  for (const int i : c.members) {
    const double along = c.fit.line.direction.dot(points[i].position - c.fit.line.centroid);
    c.low = std::min(c.low, along);
    c.high = std::max(c.high, along);
  }
  return c;
}

namespace {

constexpr int kLloydSweeps = 5;

/// On one line within the noise, and without a step longer than a wall would show.
bool isOneRun(const std::vector<SpatialPoint>& points, const PlanarCluster& c) {
  const Eigen::Vector2d& u = c.fit.line.direction;
  std::vector<double> along;
  for (const int i : c.members) {
    const Eigen::Vector2d off = points[i].position - c.fit.line.centroid;
    if (std::abs(cross(u, off)) > kNormalGate * std::sqrt(c.fit.variance)) {
      return false;
    }
    along.push_back(u.dot(off));
  }
  std::sort(along.begin(), along.end());
  for (std::size_t i = 1; i < along.size(); ++i) {
    if (along[i] - along[i - 1] > c.reach) return false;
  }
  return true;
}

void prune(const std::vector<SpatialPoint>& points, std::vector<int> members,
           std::vector<PlanarCluster>* kept) {
  if (members.empty()) return;
  PlanarCluster c = planarCluster(points, std::move(members));
  if (c.members.size() < 2 || c.high <= c.low || isOneRun(points, c)) {
    kept->push_back(std::move(c));
    return;
  }
  std::vector<Eigen::Vector2d> positions;
  for (const int i : c.members) positions.push_back(points[i].position);
  const std::vector<int> side = kMeans(positions, {c.at(c.low), c.at(c.high)}, kLloydSweeps);
  std::vector<int> parts[2];
  for (std::size_t i = 0; i < side.size(); ++i) parts[side[i]].push_back(c.members[i]);
  if (parts[0].empty() || parts[1].empty()) {
    kept->push_back(std::move(c));
    return;
  }
  for (std::vector<int>& part : parts) prune(points, std::move(part), kept);
}

}  // namespace

std::vector<PlanarCluster> planarClusters(const std::vector<SpatialPoint>& points,
                                          int points_per_cluster) {
  std::vector<Eigen::Vector2d> positions, seeds;
  for (const SpatialPoint& p : points) positions.push_back(p.position);
  // Along x, then y: what stands in for the order of a scan.
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const Eigen::Vector2d &p = positions[a], &q = positions[b];
    return p.x() != q.x() ? p.x() < q.x() : p.y() != q.y() ? p.y() < q.y() : a < b;
  });
  for (std::size_t i = points_per_cluster / 2; i < order.size(); i += points_per_cluster) {
    seeds.push_back(positions[order[i]]);
  }
  if (seeds.empty() && !positions.empty()) seeds.push_back(positions[0]);
  const std::vector<int> cluster = kMeans(positions, seeds, kLloydSweeps);
  std::vector<std::vector<int>> members(seeds.size());
  for (std::size_t i = 0; i < cluster.size(); ++i)
    members[cluster[i]].push_back(static_cast<int>(i));
  std::vector<PlanarCluster> kept;
  for (std::vector<int>& m : members) prune(points, std::move(m), &kept);
  return kept;
}

}  // namespace cca
