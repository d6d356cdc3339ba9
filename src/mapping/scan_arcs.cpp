// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/scan_arcs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cca_mrpt/mapping/arcs_of_chain.hpp"

namespace cca {
namespace {

/// Runs that follow one another without a break, as a chain.
struct Chain {
  std::vector<CurvePoint> points;
  std::vector<ChainLink> links;

  void add(const ScanPoints& scan, const FittedRun& run, const PointNoise& noise) {
    const int first = static_cast<int>(points.size());
    const double variance = run.is_line ? noise.onLine(run.line.centroid, run.line.direction).across
                                        : noise.range_sigma * noise.range_sigma;
    for (int i = run.first; i < run.last; ++i) points.push_back({scan.positions[i], variance});
    links.push_back({first, first + run.size(), run.is_line});
  }
};

/// Whether a ray beside the end of a run goes on behind it, or does not come back.
bool isFree(const ScanPoints& points, int end, int beside) {
  return points.positions[beside].squaredNorm() > points.positions[end].squaredNorm();
}

/// The limbs of points first <= i < last, where both of their ends stand free: half a beam beyond.
std::optional<Limbs> limbsOf(const ScanPoints& points, int first, int last) {
  const int n = static_cast<int>(points.size());
  if (!points.closed && (first == 0 || last == n)) return std::nullopt;
  const int before = first > 0 ? first - 1 : n - 1, after = last < n ? last : 0;
  if (!isFree(points, first, before) || !isFree(points, last - 1, after)) return std::nullopt;
  const double half = 0.5 * points.beam_spacing;
  const Eigen::Rotation2Dd turn(half);
  const Eigen::Vector2d &p = points.positions[first], &q = points.positions[last - 1];
  const double deviation = half / std::sqrt(3.0) * std::max(p.norm(), q.norm());  // uniform
  return Limbs{turn.inverse() * p.normalized(), turn * q.normalized(), deviation * deviation};
}

}  // namespace

std::vector<Arc> arcsOfScan(const ScanPoints& points, const Runs& runs, PointNoise noise,
                            double vertex_price) {
  const double least_bulge =
      std::exchange(noise.straightness, 0.0);  // a bulge is told from the noise of the laser alone
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k < runs.size();) {
    Chain chain;
    const int first = runs[k].first;
    chain.add(points, runs[k++], noise);
    while (k < runs.size() && areNeighbours(points, runs[k - 1], runs[k])) {
      chain.add(points, runs[k++], noise);
    }
    const OneView view{limbsOf(points, first, runs[k - 1].last)};
    for (const ArcOfLinks& found :
         arcsOfChain(chain.points, chain.links, least_bulge, vertex_price, &view)) {
      arcs.push_back(found.arc);
    }
  }
  return arcs;
}

}  // namespace cca
