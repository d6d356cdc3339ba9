// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/point_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mapping/k_means.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

/// nats. Between two clusters of one wall the best of the places that a boundary may go to is
/// better by about so much by chance; the two are merged before it matters.
constexpr double kWorthMoving = 2.0;

bool isLinear(const ScanPoints& points, const FittedRun& run) {
  if (run.size() <= 2) return true;
  const double gate_sq = kNormalGate * kNormalGate * run.variance;
  if (run.line.residual_sum_sq <= gate_sq) return true;
  const Eigen::Vector2d normal(-run.line.direction.y(), run.line.direction.x());
  for (int i = run.first; i < run.last; ++i) {
    const double distance = normal.dot(points.positions[i] - run.line.centroid);
    if (distance * distance > gate_sq) return false;
  }
  return true;
}

/// The best two means of a run, exactly: where the sum of squares about two centroids is least.
int splitByTwoMeans(const PrefixMoments& prefix, int first, int last) {
  int split = first + 1;
  double least = std::numeric_limits<double>::infinity();
  for (int i = first + 1; i < last; ++i) {
    const double within =
        prefix.run(first, i).scatter.trace() + prefix.run(i, last).scatter.trace();
    if (within < least) {
      least = within;
      split = i;
    }
  }
  return split;
}

void prune(const ScanPoints& points, const RunFitter& fitter, int first, int last,
           const Ablation& without, Runs* kept) {
  const FittedRun run = fitter.fit(first, last);
  if (without(Part::kPruning) || isLinear(points, run)) {
    kept->push_back(run);
    return;
  }
  const int split = splitByTwoMeans(fitter.prefix(), first, last);
  prune(points, fitter, first, split, without, kept);
  prune(points, fitter, split, last, without, kept);
}

}  // namespace

Runs pointClusters(const ScanPoints& points, const RunFitter& fitter, const Ablation& without) {
  const int n = static_cast<int>(points.size());
  const int clusters = std::max(1, (n + kPointsPerCluster / 2) / kPointsPerCluster);
  const auto share = [&](int i) { return static_cast<int>((i + 0.5) * clusters / n); };
  Runs runs;
  runs.reserve(2 * static_cast<std::size_t>(clusters));
  for (int first = 0; first < n;) {
    int last = first + 1;
    while (last < n && share(last) == share(first) && points.breaksBetween(last - 1, last) == 0)
      ++last;
    prune(points, fitter, first, last, without, &runs);
    first = last;
  }
  if (!without(Part::kKMeans)) kMeans(points, fitter, &runs, kWorthMoving);
  return runs;
}

}  // namespace cca
