// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/adaptive_fuzzy_clustering.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "baselines/inliers.hpp"

namespace cca::baselines {
namespace {

constexpr int kRounds = 20;              // of the memberships; they settle in fewer
constexpr double kLeastDistance = 1e-6;  // m, on a line

using Lines = std::vector<FittedLine>;

/// Of a point in each line; what is missing to 1 is noise.
std::vector<double> memberships(const Lines& lines, const Eigen::Vector2d& point, double noise) {
  std::vector<double> shares;
  double sum = 1.0 / (noise * noise);
  for (const FittedLine& line : lines) {
    const double d = std::max(distanceFrom(line, point), kLeastDistance);
    shares.push_back(1.0 / (d * d));
    sum += shares.back();
  }
  for (double& share : shares) share /= sum;
  return shares;
}

void settle(const Points& points, double noise, Lines& lines) {
  for (int round = 0; round < kRounds; ++round) {
    std::vector<PointMoments> moments(lines.size());
    for (const Eigen::Vector2d& point : points) {
      const std::vector<double> shares = memberships(lines, point, noise);
      for (std::size_t k = 0; k < lines.size(); ++k) moments[k].add(point, shares[k] * shares[k]);
    }
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (moments[k].weight > 0.0) lines[k] = fitLine(moments[k]);
    }
  }
}

/// The points that are more of a line's than of all others' and of the noise's, by line.
std::vector<Points> dealOut(const Points& points, const Lines& lines, double noise) {
  std::vector<Points> clusters(lines.size());
  for (const Eigen::Vector2d& point : points) {
    const std::vector<double> shares = memberships(lines, point, noise);
    const auto most = std::max_element(shares.begin(), shares.end());
    if (*most >= 0.5) clusters[static_cast<std::size_t>(most - shares.begin())].push_back(point);
  }
  return clusters;
}

double thicknessOf(const Points& points) {
  const PointMoments moments = momentsOf(points, {0, points.size()});
  return std::sqrt(principalAxis(moments).residual_sum_sq / std::max(moments.weight, 1.0));
}

/// One segment, or two where one would be too thick.
std::vector<Points> clusterCell(const Points& points, const AdaptiveFuzzyClusteringParameters& p) {
  if (points.size() < 2) return {};
  if (points.size() < 4 || thicknessOf(points) <= p.thickness) return {points};
  const std::size_t cut = farthestFromChord(points, {0, points.size()});
  const std::size_t middle = std::clamp<std::size_t>(cut, 2, points.size() - 2);
  Lines lines{fitLine(momentsOf(points, {0, middle})),
              fitLine(momentsOf(points, {middle, points.size()}))};
  settle(points, p.noise, lines);
  return dealOut(points, lines, p.noise);
}

/// m, between the ends of two segments.
double gapBetween(const LineSegment& a, const LineSegment& b) {
  const auto gap = [](const Eigen::Vector2d& p, const LineSegment& s) {
    const Eigen::Vector2d along = s.end - s.start;
    const double length_sq = along.squaredNorm();
    const double at = length_sq > 0.0 ? along.dot(p - s.start) / length_sq : 0.0;
    return (p - s.start - std::clamp(at, 0.0, 1.0) * along).norm();
  };
  return std::min({gap(a.start, b), gap(a.end, b), gap(b.start, a), gap(b.end, a)});
}

/// Merges the two clusters of the thinnest union, until none is thin enough.
void merge(std::vector<Points>& clusters, const AdaptiveFuzzyClusteringParameters& p) {
  while (true) {
    double thinnest = p.thickness;
    std::size_t first = 0, second = 0;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      for (std::size_t j = i + 1; j < clusters.size(); ++j) {
        if (gapBetween(segmentThrough(clusters[i]), segmentThrough(clusters[j])) > p.max_gap)
          continue;
        PointMoments both = momentsOf(clusters[i], {0, clusters[i].size()});
        both.add(momentsOf(clusters[j], {0, clusters[j].size()}));
        const double thickness = std::sqrt(principalAxis(both).residual_sum_sq / both.weight);
        if (thickness < thinnest) thinnest = thickness, first = i, second = j;
      }
    }
    if (second == 0) return;
    clusters[first].insert(clusters[first].end(), clusters[second].begin(), clusters[second].end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(second));
  }
}

}  // namespace

AdaptiveFuzzyClusteringParameters AdaptiveFuzzyClusteringParameters::tuned() {
  return {{4, 0.30}, 0.68, 0.14, 0.068, 0.72};
}

std::vector<LineSegment> adaptiveFuzzyClustering(const Scan& scan,
                                                 const AdaptiveFuzzyClusteringParameters& p) {
  std::map<std::pair<int, int>, Points> cells;
  for (const Eigen::Vector2d& point : returnedPoints(scan)) {
    cells[{static_cast<int>(std::floor(point.x() / p.cell)),
           static_cast<int>(std::floor(point.y() / p.cell))}]
        .push_back(point);
  }
  std::vector<Points> clusters;
  for (const auto& [cell, points] : cells) {
    for (Points& cluster : clusterCell(points, p)) {
      if (cluster.size() >= 2) clusters.push_back(std::move(cluster));
    }
  }
  merge(clusters, p);
  std::vector<LineSegment> segments;
  for (const Points& cluster : clusters) {
    const LineSegment segment = segmentThrough(cluster);
    if (isLongEnough(segment, cluster.size(), p.limits)) segments.push_back(segment);
  }
  sortByBearing(segments);
  return segments;
}

}  // namespace cca::baselines
