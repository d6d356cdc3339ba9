// SPDX-License-Identifier: BSD-3-Clause
// What each step from a scan to its lines costs, against the number of beams and of walls.
#include <benchmark/benchmark.h>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "mapping/corner_refinement.hpp"
#include "mapping/k_means.hpp"
#include "mapping/point_clusters.hpp"
#include "mapping/poly_lines.hpp"
#include "mapping/rank_order_clustering.hpp"
#include "sensing/polygon_room.hpp"

namespace cca {
namespace {

constexpr double kSigma = 0.03;
constexpr int kWalls = 12;

/// A star-shaped room of that many walls, 3 to 6 m away.
PolygonRoom starRoom(int walls) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(3.0, 6.0);
  PolygonRoom room;
  for (int k = 0; k < walls; ++k) {
    const double bearing = 2.0 * M_PI * k / walls;
    room.vertices.push_back(radius(random) * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)));
  }
  return room;
}

Scan scanWith(int beams, int walls) {
  std::mt19937 random(6);
  return scanOf(starRoom(walls), -M_PI, 2.0 * M_PI / beams, beams, kSigma, &random);
}

PointNoise noiseOf(const Scan& scan) {
  PointNoise noise = rangeNoise(scan);
  noise.straightness = CcaParameters().straightness;
  return noise;
}

/// A scan on its way, up to the step that is measured.
struct Stage {
  ScanPoints points;
  PointNoise noise;
  RunFitter fitter;
  Runs clusters, merged, refined;

  explicit Stage(int beams)
      : points(scanPoints(scanWith(beams, kWalls), kSigma)),
        noise(noiseOf(scanWith(beams, kWalls))),
        fitter(points.positions, noise),
        clusters(pointClusters(points, fitter)),
        merged(clusters) {
    while (mergeConsecutive(points, fitter, 0.5, &merged)) {
    }
    refined = merged;
    while (refineCorners(points, fitter, &refined)) {
    }
  }
};

int beamsOf(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

void ScanToPoints(benchmark::State& state) {
  const Scan scan = scanWith(beamsOf(state), kWalls);
  for (auto _ : state) benchmark::DoNotOptimize(scanPoints(scan));
  state.SetComplexityN(state.range(0));
}

void RangeNoise(benchmark::State& state) {
  const Scan scan = scanWith(beamsOf(state), kWalls);
  for (auto _ : state) benchmark::DoNotOptimize(rangeNoise(scan));
  state.SetComplexityN(state.range(0));
}

void KMeans(benchmark::State& state) {
  const Stage s(beamsOf(state));
  const Runs shares = pointClusters(s.points, s.fitter, Ablation(Part::kKMeans));
  for (auto _ : state) {
    Runs runs = shares;
    kMeans(s.points, s.fitter, &runs);
    benchmark::DoNotOptimize(runs);
  }
  state.SetComplexityN(state.range(0));
}

void PointClusters(benchmark::State& state) {
  const Stage s(beamsOf(state));
  for (auto _ : state) {
    benchmark::DoNotOptimize(pointClusters(s.points, s.fitter));
  }
  state.SetComplexityN(state.range(0));
}

void SimilarityRankOrderMerge(benchmark::State& state) {
  const Stage s(beamsOf(state));
  for (auto _ : state) {
    Runs runs = s.clusters;
    while (mergeConsecutive(s.points, s.fitter, 0.5, &runs)) {
    }
    benchmark::DoNotOptimize(runs);
  }
  state.SetComplexityN(state.range(0));
}

void RefineCorners(benchmark::State& state) {
  const Stage s(beamsOf(state));
  for (auto _ : state) {
    Runs runs = s.merged;
    while (refineCorners(s.points, s.fitter, &runs)) {
    }
    benchmark::DoNotOptimize(runs);
  }
  state.SetComplexityN(state.range(0));
}

void GroupInterrupted(benchmark::State& state) {
  const Stage s(beamsOf(state));
  for (auto _ : state) {
    benchmark::DoNotOptimize(groupInterrupted(s.points, s.fitter, 0.5, s.refined));
  }
  state.SetComplexityN(state.range(0));
}

void PolyLines(benchmark::State& state) {
  const Stage s(beamsOf(state));
  const auto groups = groupInterrupted(s.points, s.fitter, 0.5, s.refined);
  for (auto _ : state) {
    benchmark::DoNotOptimize(polyLines(s.points, s.fitter, s.refined, groups));
  }
  state.SetComplexityN(state.range(0));
}

void ExtractLinesOfScan(benchmark::State& state) {
  const Scan scan = scanWith(beamsOf(state), kWalls);
  for (auto _ : state) benchmark::DoNotOptimize(extractLines(scan));
  state.SetComplexityN(state.range(0));
}

void ExtractLinesAgainstWalls(benchmark::State& state) {
  const Scan scan = scanWith(1440, static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(extractLines(scan));
  state.SetComplexityN(state.range(0));
}

/// The two sorts alone, on the similarities of n segments in walls of eight.
void RankOrderClustering(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  SimilarityMatrix s(n);
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n && j / 8 == i / 8; ++j) s.set(i, j, 0.9);
  }
  for (auto _ : state) benchmark::DoNotOptimize(rankOrderGroups(s, 0.5));
  state.SetComplexityN(state.range(0));
}

#define AGAINST_BEAMS(step) \
  BENCHMARK(step)->RangeMultiplier(2)->Range(90, 11520)->Unit(benchmark::kMicrosecond)->Complexity()
AGAINST_BEAMS(ScanToPoints);
AGAINST_BEAMS(RangeNoise);
AGAINST_BEAMS(KMeans);
AGAINST_BEAMS(PointClusters);
AGAINST_BEAMS(SimilarityRankOrderMerge);
AGAINST_BEAMS(RefineCorners);
AGAINST_BEAMS(GroupInterrupted);
AGAINST_BEAMS(PolyLines);
AGAINST_BEAMS(ExtractLinesOfScan);
BENCHMARK(ExtractLinesAgainstWalls)
    ->RangeMultiplier(2)
    ->Range(4, 128)
    ->Unit(benchmark::kMicrosecond)
    ->Complexity();
BENCHMARK(RankOrderClustering)
    ->RangeMultiplier(2)
    ->Range(8, 1024)
    ->Unit(benchmark::kMicrosecond)
    ->Complexity();

}  // namespace
}  // namespace cca

BENCHMARK_MAIN();
