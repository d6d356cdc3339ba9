// SPDX-License-Identifier: BSD-3-Clause
#include "progress_line.hpp"

#include <unistd.h>

#include <cstdio>

namespace cca::apps {

namespace {
constexpr auto kEvery = std::chrono::milliseconds(200);
}

ProgressLine::ProgressLine(bool wanted) : enabled_(wanted && isatty(STDERR_FILENO) == 1) {}

bool ProgressLine::isDue() const { return enabled_ && Clock::now() - last_ >= kEvery; }

void ProgressLine::show(const State& state) {
  last_ = Clock::now();
  shown_ = true;
  const double wall = std::chrono::duration<double>(last_ - start_).count();
  char coverage[32] = "  ... ", goal[48] = "none";
  if (state.coverage) std::snprintf(coverage, sizeof coverage, "%5.1f %%", 100.0 * *state.coverage);
  if (state.goal) std::snprintf(goal, sizeof goal, "%.1f, %.1f", state.goal->x(), state.goal->y());
  std::fprintf(stderr, "\r%s seen  %.0f m  %.0f s simulated  goal %s  %.0f scans/s  %s left\033[K",
               coverage, state.distance, state.time, goal,
               static_cast<double>(state.scans) / (wall > 0.0 ? wall : 1.0),
               timeLeft(state.coverage.value_or(0.0), wall).c_str());
  std::fflush(stderr);
}

/// As if the rest went at the speed so far; the last corners usually take longer.
std::string ProgressLine::timeLeft(double coverage, double wall) const {
  if (coverage < 0.05) return "?";
  char text[32];
  std::snprintf(text, sizeof text, "%.0f s", wall * (1.0 - coverage) / coverage);
  return text;
}

void ProgressLine::clear() {
  if (shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

}  // namespace cca::apps
