// SPDX-License-Identifier: BSD-3-Clause
// What a pose costs, see kUsage. Prints tables, as it measures single steps, which Google Benchmark
// averages away.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string_view>
#include <vector>

#include "cca_mrpt/slam/slam.hpp"
#include "io/poses/local_frame.hpp"

namespace cca {
namespace {

constexpr const char* kUsage =
    "usage: slam_benchmark LOG...\n\n"
    "Goes through logs as a robot would meet them, and prints the processor time [ms] of each step "
    "of SLAM,\nand of the last pass over all. Status 2: a log cannot be read.";

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
  if (argc < 2 || std::string_view(argv[1]) == "--help") {
    std::puts(cca::kUsage);
    return argc < 2 ? 2 : 0;
  }
  std::puts(
      "| log | scans | beams | key frames | loops | median, ms | 90 % | 99 % | longest | last pass "
      "| scans/s |\n|---|---|---|---|---|---|---|---|---|---|---|");
  try {
    for (int k = 1; k < argc; ++k) cca::measure(argv[k]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "slam_benchmark: %s\n", error.what());
    return 2;
  }
}
