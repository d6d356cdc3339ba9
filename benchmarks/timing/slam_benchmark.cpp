// SPDX-License-Identifier: BSD-3-Clause
// What a pose costs: slam_benchmark LOG... goes through logs as a robot would meet them, and prints
// the processor time [ms] of Slam::step(), and of the last pass. Prints tables, as it measures
// single steps, which Google Benchmark averages away.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "cca_mrpt/slam/slam.hpp"
#include "io/poses/local_frame.hpp"

namespace cca {
namespace {

/// Of this thread: what else the machine does is not counted.
double processorMs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(
      std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

void measure(const char* path) {
  LocalLog log(openUndistortedLog(path));
  Slam slam;
  std::vector<double> steps;
  std::size_t beams = 0;
  double all = 0.0;
  while (const auto record = log.next()) {
    beams = record->scan.size();
    const double begin = processorMs();
    slam.step(record->scan, record->T_robot_sensor, record->odometry);
    steps.push_back(processorMs() - begin);
    all += steps.back();
  }
  if (steps.empty()) return;
  const double begin = processorMs();
  slam.finish();
  const double finish = processorMs() - begin;
  std::sort(steps.begin(), steps.end());
  std::printf("| %s | %zu | %zu | %d | %zu | %.2f | %.2f | %.2f | %.1f | %.0f | %.0f |\n",
              std::filesystem::path(path).filename().c_str(), steps.size(), beams,
              slam.graph().size(), slam.loopsClosed(), quantile(steps, 0.5), quantile(steps, 0.9),
              quantile(steps, 0.99), steps.back(), finish,
              1e3 * static_cast<double>(steps.size()) / (all + finish));
}

}  // namespace
}  // namespace cca

int main(int argc, char** argv) {
  std::puts(
      "| log | scans | beams | key frames | loops | median, ms | 90 % | 99 % | longest | last pass "
      "| scans/s |\n|---|---|---|---|---|---|---|---|---|---|---|");
  for (int k = 1; k < argc; ++k) cca::measure(argv[k]);
}
