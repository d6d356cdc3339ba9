// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_extraction.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/mapping/point_clusters.hpp"
#include "cca_mrpt/mapping/range_noise.hpp"
#include "cca_mrpt/mapping/rank_order_clustering.hpp"
#include "cca_mrpt/mapping/similarity.hpp"

namespace cca {
namespace {

/// Two points always fit a line: three are the least that can speak against it.
constexpr int kFewestPoints = 3;
/// Share of a ray's length or of the noise that it may pass behind a line without contradicting it.
constexpr double kPassGate = 3.0;

/// A line in the making: its runs of points in scan order.
struct Candidate {
  std::vector<PointCluster> runs;
  LineSegment segment;
};

void refit(const ScanPoints& points, const PointNoise& noise, Candidate* c) {
  const FittedLine line = fitLine(c->segment.moments);
  double low = 0.0, high = 0.0;
  for (const PointCluster& run : c->runs) {
    for (const int i : {run.first, run.last - 1}) {
      const double along = line.direction.dot(points.positions[i] - line.centroid);
      low = std::min(low, along);
      high = std::max(high, along);
    }
  }
  c->segment.start = line.centroid + low * line.direction;
  c->segment.end = line.centroid + high * line.direction;
  const double variance = noise.lateralVariance(line.centroid, line.direction);
  c->segment.covariance(0, 0) = variance / c->segment.moments.weight;
  c->segment.covariance(1, 1) =
      line.spread_sum_sq > 0.0 ? std::min(variance / line.spread_sum_sq, 1.0) : 1.0;
}

/// Rays between the two that passed through their joint line, or did not return.
double raysThrough(const ScanPoints& points, const PointNoise& noise, const Candidate& a,
                   const Candidate& b) {
  const Candidate& left = a.runs.front().first < b.runs.front().first ? a : b;
  const Candidate& right = &left == &a ? b : a;
  const int from = left.runs.back().last - 1, to = right.runs.front().first;
  if (from >= to) return 0.0;
  PointMoments joint = a.segment.moments;
  joint.add(b.segment.moments);
  const FittedLine line = fitLine(joint);
  const Eigen::Vector2d normal(-line.direction.y(), line.direction.x());
  const double offset = normal.dot(line.centroid);
  double through = points.beams[to] - points.beams[from] - (to - from);
  const double gate = kPassGate * std::sqrt(noise.lateralVariance(line.centroid, line.direction));
  for (int i = from + 1; i < to; ++i) {
    const double beyond = normal.dot(points.positions[i]) - offset;
    if (offset > 0.0 ? beyond > gate : beyond < -gate) through += 1.0;
  }
  return through;
}

SimilarityMatrix similarityMatrix(const ScanPoints& points, const PointNoise& noise,
                                  const std::vector<Candidate>& candidates) {
  const int n = static_cast<int>(candidates.size());
  SimilarityMatrix s(n);
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      Memberships mu = memberships(candidates[i].segment, candidates[j].segment, 0.0);
      if (mu.similarity() > 0.1) {
        mu = memberships(candidates[i].segment, candidates[j].segment,
                         raysThrough(points, noise, candidates[i], candidates[j]));
      }
      s.set(i, j, mu.similarity());
    }
  }
  return s;
}

Candidate merged(const ScanPoints& points, const PointNoise& noise,
                 const std::vector<Candidate>& candidates, const std::vector<int>& group) {
  Candidate whole;
  for (const int k : group) {
    whole.segment.moments.add(candidates[k].segment.moments);
    whole.runs.insert(whole.runs.end(), candidates[k].runs.begin(), candidates[k].runs.end());
  }
  std::sort(whole.runs.begin(), whole.runs.end(),
            [](const PointCluster& a, const PointCluster& b) { return a.first < b.first; });
  refit(points, noise, &whole);
  return whole;
}

}  // namespace

std::vector<LineSegment> extractLines(const Scan& scan, const CcaParameters& parameters) {
  const ScanPoints points = scanPoints(scan);
  const PointNoise noise = rangeNoise(scan);
  const PrefixMoments prefix(points.positions);
  std::vector<Candidate> candidates;
  for (const PointCluster& run :
       pointClusters(points, prefix, noise, parameters.points_per_cluster)) {
    Candidate c;
    c.runs = {run};
    c.segment.moments = prefix.run(run.first, run.last);
    refit(points, noise, &c);
    candidates.push_back(c);
  }
  for (bool merging = true; merging;) {
    const auto groups =
        rankOrderGroups(similarityMatrix(points, noise, candidates), parameters.similarity_cut);
    merging = groups.size() < candidates.size();
    std::vector<Candidate> next;
    for (const auto& group : groups) next.push_back(merged(points, noise, candidates, group));
    std::sort(next.begin(), next.end(), [](const Candidate& a, const Candidate& b) {
      return a.runs.front().first < b.runs.front().first;
    });
    candidates.swap(next);
  }
  std::vector<LineSegment> lines;
  for (const Candidate& c : candidates) {
    if (c.segment.moments.weight >= kFewestPoints && c.segment.length() > 0.0) {
      lines.push_back(c.segment);
    }
  }
  return lines;
}

}  // namespace cca
