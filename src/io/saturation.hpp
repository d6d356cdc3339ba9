// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <unordered_map>

namespace cca {

/// Finds out which readings of a log stand for "no return", where the format has no word for it:
/// drivers then write one of a few values at the top of the scale (81.91, 81.83, 51.1, 32.767 m).
class Saturation {
 public:
  /// @param range  m; anything. Readings beyond kImpossible are left out.
  void add(double range);

  /// Readings from here on are no returns; +infinity where all are returns.
  ///
  /// They are there if the readings within 4 % of the largest outnumber those of the next 10 %, and
  /// if a handful of values, each read more than once, makes up most of them: the far wall of a
  /// small room also heaps readings at the top of a short log, but its readings differ.
  double threshold() const;

  /// m; no indoor laser reads that far: readings beyond are damage, not the top of a scale.
  static constexpr double kImpossible = 1000.0;

 private:
  double lowestKept() const;

  double largest_ = 0.0;
  std::unordered_map<double, std::uint64_t> counts_;  ///< readings near the largest so far
};

}  // namespace cca
