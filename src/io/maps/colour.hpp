// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace cca {

/// Shares of the light, in [0, 1].
struct Colour {
  double red, green, blue, alpha = 1.0;
};

/// 0xRRGGBB
inline std::uint32_t rgb(const Colour& colour) {
  const auto byte = [](double v) { return static_cast<std::uint32_t>(std::lround(255.0 * v)); };
  return byte(colour.red) << 16 | byte(colour.green) << 8 | byte(colour.blue);
}

}  // namespace cca
