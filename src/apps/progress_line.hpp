// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <string>

namespace cca::apps {

/// One line on the terminal that is written over, a few times a second; none where the error
/// output is no terminal.
class ProgressLine {
 public:
  struct State {
    std::optional<double> coverage;  ///< share, where known
    double distance = 0.0;           ///< m
    double time = 0.0;               ///< s, simulated
    std::optional<Eigen::Vector2d> goal;
    long scans = 0;
  };

  explicit ProgressLine(bool wanted);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool isDue() const;
  void show(const State& state);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string timeLeft(double coverage, double wall) const;

  bool enabled_, shown_ = false;
  Clock::time_point start_ = Clock::now(), last_;
};

}  // namespace cca::apps
