// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace cca::apps {

/// One line on the terminal that tells how far the work is and how long it will take; nothing where
/// the error output is no terminal.
class Progress {
 public:
  explicit Progress(std::string what);
  /// Removes the line.
  ~Progress();

  /// Whether show() would show anything now.
  bool isDue() const { return terminal_ && Clock::now() - last_ >= kPeriod; }
  /// @param done  in [0, 1]. Costs next to nothing when called often.
  void show(double done, const std::string& detail);

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPeriod{200};

  std::string what_;
  bool terminal_, shown_ = false;
  Clock::time_point begin_, last_;
};

}  // namespace cca::apps
