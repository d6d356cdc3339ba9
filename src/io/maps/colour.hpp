// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cca {

/// Shares of the light, in [0, 1].
struct Colour {
  double red, green, blue, alpha = 1.0;
};

}  // namespace cca
