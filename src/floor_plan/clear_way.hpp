// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/floor_plan/raster.hpp"

namespace cca {

/// Whether a segment crosses open cells only, but for `ends` metres at both its ends.
inline bool isClear(const Mask& solid, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                    double ends) {
  const double length = (b - a).norm(), step = 0.5 * solid.resolution;
  for (double s = ends; s < length - ends; s += step) {
    if (solid.at(solid.cellOf(a + s / length * (b - a)), 1)) return false;
  }
  return true;
}

}  // namespace cca
