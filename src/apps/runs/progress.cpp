// SPDX-License-Identifier: BSD-3-Clause
#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cca::apps {
namespace {
constexpr double kEnoughToForecast = 0.02;
}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(Clock::now()),
      last_(begin_) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::show(double done, const std::string& detail) {
  if (!isDue()) return;
  last_ = Clock::now();
  shown_ = true;
  // Whoever still shows progress is not done.
  const double percent = std::min(std::floor(100.0 * done), 99.0);
  std::fprintf(stderr, "\r\033[K%s: %3.0f %%, %s", what_.c_str(), percent, detail.c_str());
  if (done > kEnoughToForecast) {
    const double spent = std::chrono::duration<double>(last_ - begin_).count();
    std::fprintf(stderr, ", %.0f s left", std::max(1.0, spent * (1.0 - done) / done));
  }
  std::fflush(stderr);
}

}  // namespace cca::apps
