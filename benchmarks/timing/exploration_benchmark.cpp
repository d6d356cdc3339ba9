// SPDX-License-Identifier: BSD-3-Clause
// What a step of the global planner costs in a place of 100 x 100 m at 5 cm: rooms of 10 m with
// doors, half of them known.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "cca_mrpt/geometry/cell.hpp"
#include "navigation/planning/global_planner.hpp"

namespace {

constexpr double kResolution = 0.05;
constexpr int kSide = 2000, kRoom = 200;  // cells

bool isWall(cca::Cell c) {
  if (c.x < 0 || c.y < 0 || c.x >= kSide || c.y >= kSide) return true;
  const int x = c.x % kRoom, y = c.y % kRoom;
  const bool door_x = y > 80 && y<104, door_y = x> 80 && x < 104;  // 1.15 m wide
  return (x < 3 && !door_x) || (y < 3 && !door_y) || c.x < 3 || c.y < 3;
}

cca::Scan scanFrom(double x, double y) {
  cca::Scan scan;
  scan.angle_min = -M_PI;
  scan.angle_increment = M_PI / 180.0;
  scan.free_range_without_return = 8.0;
  scan.T_map_sensor = {x, y, 0.0};
  for (std::size_t k = 0; k <= 360; ++k) {
    double range = std::numeric_limits<double>::infinity();
    const double angle = scan.bearing(k);
    cca::walkBeam({x / kResolution, y / kResolution}, {std::cos(angle), std::sin(angle)},
                  8.0 / kResolution, [&](cca::Cell c, double entered) {
                    if (!isWall(c)) return true;
                    range = entered * kResolution;
                    return false;
                  });
    scan.ranges.push_back(range);
  }
  return scan;
}

/// Half of it known, the rest to be explored.
cca::WorldModel halfway() {
  cca::WorldModel world;
  std::vector<cca::Cell> free, occupied;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide / 2; ++x) (isWall({x, y}) ? occupied : free).push_back({x, y});
  }
  world.seed(occupied, cca::CellState::kOccupied);
  world.seed(free, cca::CellState::kFree);
  return world;
}

/// Steps of a point that follows the plan; counters in ms of processor time, a step.
void BM_PlanningStep(benchmark::State& state) {
  cca::WorldModel world = halfway();
  cca::GlobalPlanner planner;
  Eigen::Vector2d robot(45.0, 45.0);
  std::vector<double> took_ms;
  for (auto _ : state) {
    state.PauseTiming();
    const cca::Scan scan = scanFrom(robot.x(), robot.y());
    state.ResumeTiming();
    const std::clock_t start = std::clock();
    world.observe(scan, robot);
    const cca::Plan& plan = planner.update(world, robot);
    took_ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    state.PauseTiming();
    if (plan.path.size() > 1 && plan.path[1] != robot)
      robot += std::min(0.07, (plan.path[1] - robot).norm()) * (plan.path[1] - robot).normalized();
    state.ResumeTiming();
  }
  std::sort(took_ms.begin(), took_ms.end());
  state.counters["median_ms"] = took_ms[took_ms.size() / 2];
  state.counters["worst_ms"] = took_ms.back();
}
BENCHMARK(BM_PlanningStep)->Unit(benchmark::kMillisecond)->Iterations(400);

}  // namespace

BENCHMARK_MAIN();
