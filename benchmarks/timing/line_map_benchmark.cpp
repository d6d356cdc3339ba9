// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "mapping/segment_world.hpp"
#include "mapping/walls.hpp"

namespace {

using namespace cca;

struct Seen {
  Scan scan;
  std::vector<LineSegment> lines;
};

/// A row of rooms along a corridor, each with a few crates, and a drive through the corridor.
std::vector<Seen> corridor(int rooms, int beams) {
  SegmentWorld world;
  std::mt19937 random(1);
  for (int i = 0; i < rooms; ++i) {
    const double x = 5.0 * i;
    world.walls.push_back({{x, 1.0}, {x + 4.0, 1.0}});
    world.walls.push_back({{x, -1.0}, {x + 4.0, -1.0}});
    world.box(x, 1.2, x + 4.8, 6.0);
    world.box(x + 1.0, -3.0, x + 1.6, -2.4);
  }
  std::vector<Seen> seen;
  for (double x = 0.5; x < 5.0 * rooms; x += 0.25) {
    Scan scan = world.scan({x, 0.0, 0.0}, 0.01, random, beams);
    seen.push_back({scan, extractLines(scan)});
  }
  return seen;
}

void insertAll(LineMap& map, const std::vector<Seen>& seen) {
  for (const Seen& s : seen) map.insert(s.scan, s.lines);
}

benchmark::Counter perScan(std::size_t scans) {
  return benchmark::Counter(
      static_cast<double>(scans),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// The merge alone (extraction is done before): the first lap in a world of growing size.
void BM_InsertIntoAGrowingMap(benchmark::State& state) {
  const auto seen = corridor(static_cast<int>(state.range(0)), 360);
  for (auto _ : state) {
    LineMap map;
    insertAll(map, seen);
    benchmark::DoNotOptimize(map.walls().all().size());
  }
  state.counters["scan"] = perScan(seen.size());
}
BENCHMARK(BM_InsertIntoAGrowingMap)->Arg(2)->Arg(8)->Arg(32)->Unit(benchmark::kMillisecond);

// Another lap of the same scans after 1 and 10 laps: nothing may grow with how often a wall was
// seen.
void BM_InsertAfterLaps(benchmark::State& state) {
  const auto seen = corridor(8, 360);
  LineMap map;
  for (int lap = 0; lap < state.range(0); ++lap) insertAll(map, seen);
  for (auto _ : state) insertAll(map, seen);
  state.counters["scan"] = perScan(seen.size());
}
BENCHMARK(BM_InsertAfterLaps)->Arg(1)->Arg(10)->Iterations(3)->Unit(benchmark::kMillisecond);

void BM_InsertByBeams(benchmark::State& state) {
  const auto seen = corridor(8, static_cast<int>(state.range(0)));
  for (auto _ : state) {
    LineMap map;
    insertAll(map, seen);
    benchmark::DoNotOptimize(map.walls().all().size());
  }
  state.counters["scan"] = perScan(seen.size());
}
BENCHMARK(BM_InsertByBeams)->Arg(180)->Arg(360)->Arg(720)->Unit(benchmark::kMillisecond);

void BM_Lines(benchmark::State& state) {
  LineMap map;
  insertAll(map, corridor(static_cast<int>(state.range(0)), 360));
  for (auto _ : state) benchmark::DoNotOptimize(map.lines());
  state.counters["lines"] = static_cast<double>(map.lines().size());
}
BENCHMARK(BM_Lines)->Arg(2)->Arg(8)->Arg(32)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
