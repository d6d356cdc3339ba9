// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace cca {

/// A seeded stream of random numbers that is the same on every machine: the standard fixes the
/// engine but not its distributions, so these are our own. Nothing here is global.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  double uniform(double lowest, double highest) { return lowest + (highest - lowest) * uniform(); }
  /// Uniform in lowest..highest, both included; lowest <= highest.
  int integer(int lowest, int highest) {
    return lowest + static_cast<int>(uniform() * (static_cast<double>(highest) - lowest + 1.0));
  }
  /// Standard normal (Box & Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * M_PI * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace cca
