// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_extraction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "geometry/cross.hpp"
#include "mapping/arcs_of_chain.hpp"
#include "mapping/corner_refinement.hpp"
#include "mapping/line_merging.hpp"
#include "mapping/point_clusters.hpp"
#include "mapping/poly_lines.hpp"

namespace cca {
namespace {

/// What is alike beyond doubt merges first: the cut falls to similarity_cut in these steps, given
/// as odds against likeness, in shares of the odds at similarity_cut.
constexpr double kOdds[] = {0.1, 0.4};
/// Merging and refining both shorten the description and so must end; mostly after three rounds.
constexpr int kMostRounds = 6;
/// Lines one behind another that may be a curved wall's facets: two that meet fit a corner as well.
constexpr int kFewestFacets = 3;
constexpr double kWidestFacet = M_PI / 3.0;  // rad; what turns by more is the corner of a room
constexpr double kSetSigma = 0.03;           // m, where the study leaves the scan's own noise out

/// A scan on its way to lines.
struct ClusteredScan {
  PointNoise noise;
  ScanPoints points;
  RunFitter fitter;
  Runs runs;

  /// Lets a closed scan begin with another run.
  void beginWith(std::size_t index) {
    const auto first_run = runs.begin() + static_cast<std::ptrdiff_t>(index);
    const int corner = first_run->first, n = static_cast<int>(points.size());
    std::rotate(runs.begin(), first_run, runs.end());
    for (FittedRun& run : runs) {
      const int shift = run.first >= corner ? -corner : n - corner;
      run.first += shift;
      run.last += shift;
      for (int* key : {&run.settled_with, &run.compared_with, &run.kept_from, &run.kept_to}) {
        if (*key >= 0) *key += shift;
      }
    }
    reopen(corner, &points);
    fitter = RunFitter(points.positions, noise, fitter.vertexPrice());
  }
};

PointNoise noiseOf(const Scan& scan, const CcaParameters& parameters) {
  PointNoise noise = rangeNoise(scan);
  noise.straightness = parameters.straightness;
  if (parameters.without(Part::kScanNoise)) noise.range_sigma = kSetSigma;
  return noise;
}

/// Clusters a scan again and again, until no two runs are alike and every corner is in its place.
ClusteredScan cluster(const Scan& scan, const PointNoise& noise, const CcaParameters& parameters) {
  const Ablation& without = parameters.without;
  ScanPoints points = scanPoints(scan, std::max(noise.range_sigma, noise.straightness));
  RunFitter fitter(points.positions, noise, parameters.vertex_price);
  Runs runs = pointClusters(points, fitter, without);
  ClusteredScan s{noise, std::move(points), std::move(fitter), std::move(runs)};

  const AlphaCut cut(parameters);
  for (const double share : kOdds) {
    const AlphaCut higher(1.0 / (1.0 + share * (1.0 / cut.value - 1.0)), without);
    while (!without(Part::kRounds) && mergeConsecutive(s.points, s.fitter, higher, &s.runs)) {
    }
  }
  bool changed = true;
  for (int round = 0; changed && round < kMostRounds; ++round) {
    changed = false;
    while (mergeConsecutive(s.points, s.fitter, cut, &s.runs)) {
      changed = true;
      if (without(Part::kRounds)) break;
    }
    if (without(Part::kCorners)) continue;
    if (refineCorners(s.points, s.fitter, &s.runs, without)) changed = true;
    if (round > 0 || !s.points.closed || s.runs.size() < 3) continue;
    // The circle was cut before its walls were known: it is opened on the far side of the scan, so
    // that the old seam is refined like any other place.
    s.beginWith(s.runs.size() / 2);
    changed = true;
  }
  if (!without(Part::kCorners)) {
    meetAtCorners(s.points, s.fitter, &s.runs);
    tellEdgesBetween(s.points, s.fitter, &s.runs);
  }
  return s;
}

std::vector<LineSegment> linesOf(const ClusteredScan& s, const CcaParameters& parameters) {
  const AlphaCut cut(parameters);
  return polyLines(s.points, s.fitter, s.runs, groupInterrupted(s.points, s.fitter, cut, s.runs));
}

/// Lets a closed scan begin behind a break, if it has one, so that no arc lies across its seam.
void beginBehindBreak(ClusteredScan* s) {
  for (std::size_t k = 1; s->points.closed && k < s->runs.size(); ++k) {
    if (areNeighbours(s->points, s->runs[k - 1], s->runs[k])) continue;
    return s->beginWith(k);
  }
}

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

/// Whether lines of a chain may be facets of a curved wall: so many turn the same way.
bool hasFacets(const Chain& chain) {
  int facets = 0;
  double turned = 0.0;
  Eigen::Vector2d before = Eigen::Vector2d::Zero();
  for (const ChainLink& link : chain.links) {
    const Eigen::Vector2d along = chain.points[static_cast<std::size_t>(link.last - 1)].position -
                                  chain.points[static_cast<std::size_t>(link.first)].position;
    if (!link.is_line) {
      facets = 0;
      continue;
    }
    const double turn = std::atan2(cross(before, along), before.dot(along));
    const bool goes_on = facets > 0 && std::abs(turn) < kWidestFacet;
    facets = !goes_on ? 1 : facets > 1 && turn * turned <= 0.0 ? 2 : facets + 1;
    if (facets >= kFewestFacets) return true;
    turned = turn;
    before = along;
  }
  return false;
}

/// The arcs of a scan: those that tell runs without a break between them more briefly than lines
/// do, see arcsOfChain().
/// @param only_facets  none but curved walls: no pillars, at a tenth of the time.
std::vector<Arc> arcsOfScan(const ScanPoints& points, const Runs& runs, PointNoise noise,
                            double vertex_price, bool only_facets) {
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
    if (only_facets && !hasFacets(chain)) continue;
    const OneView view{limbsOf(points, first, runs[k - 1].last)};
    for (const ArcOfLinks& found :
         arcsOfChain(chain.points, chain.links, least_bulge, vertex_price, &view)) {
      arcs.push_back(found.arc);
    }
  }
  return arcs;
}

ScanFeatures featuresOf(const Scan& scan, const PointNoise& noise, const CcaParameters& parameters,
                        bool only_facets) {
  ClusteredScan clustered = cluster(scan, noise, parameters);
  ScanFeatures features;
  features.lines = linesOf(clustered, parameters);
  beginBehindBreak(&clustered);
  features.arcs = arcsOfScan(clustered.points, clustered.runs, clustered.noise,
                             parameters.vertex_price, only_facets);
  return features;
}

}  // namespace

std::vector<LineSegment> extractLines(const Scan& scan, const CcaParameters& parameters) {
  return linesOf(cluster(scan, noiseOf(scan, parameters), parameters), parameters);
}

AnalysedScan analyse(Scan scan, const CcaParameters& parameters) {
  const PointNoise noise = noiseOf(scan, parameters);
  ScanFeatures features = featuresOf(scan, noise, parameters, true);
  return {std::move(scan), noise, std::move(features.lines), std::move(features.arcs)};
}

ScanFeatures extractFeatures(const Scan& scan, const CcaParameters& parameters) {
  return featuresOf(scan, noiseOf(scan, parameters), parameters, false);
}

}  // namespace cca
