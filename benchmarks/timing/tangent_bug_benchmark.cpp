// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "navigation/control/tangent_bug/tangent_bug.hpp"
#include "navigation/random_worlds.hpp"
#include "navigation/traps.hpp"

namespace {

using namespace cca;
using namespace cca::testing;

// One step(), over the scans of a whole drive.
void drive(benchmark::State& state, const BoxWorld& world, const Pose2& start,
           const Eigen::Vector2d& goal) {
  const RobotParameters robot;
  std::vector<std::pair<Scan, Velocity>> scans;
  TangentBug first(robot);
  first.setGoal(goal);
  Pose2 pose = start;
  Velocity velocity;
  for (int i = 0; i < 300; ++i) {
    scans.emplace_back(world.scan(pose, 8.0), velocity);
    cca::testing::drive(first.step(scans.back().first, pose, velocity, 0.1 * i), robot, 0.1, pose,
                        velocity);
  }
  for (auto _ : state) {
    TangentBug bug(robot);
    bug.setGoal(goal);
    double time = 0.0;
    for (const auto& [scan, at] : scans) {
      benchmark::DoNotOptimize(bug.step(scan, scan.T_map_sensor, at, time += 0.1));
    }
  }
  state.counters["step"] = benchmark::Counter(
      static_cast<double>(scans.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void BM_TangentBugInATrap(benchmark::State& state) {
  const Trap trap = allTraps()[static_cast<std::size_t>(state.range(0))];
  state.SetLabel(trap.name);
  drive(state, trap.world, trap.start, trap.goal);
}
BENCHMARK(BM_TangentBugInATrap)->DenseRange(0, 5)->Unit(benchmark::kMillisecond);

void BM_TangentBugAmongFurniture(benchmark::State& state) {
  const Query query = randomQuery(static_cast<unsigned>(state.range(0)));
  drive(state, query.world, query.start, query.goal);
}
BENCHMARK(BM_TangentBugAmongFurniture)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
