// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

inline constexpr double kLongestGridBeam = 25.0;  ///< m; beyond, its footprint exceeds a cell

/// The scan up to `longest` m: what returns from beyond is free up to there.
inline Scan cutOff(const Scan& scan, double longest = kLongestGridBeam) {
  Scan cut = scan;
  const bool is_silent_free = scan.free_range_without_return > 0.0;
  cut.free_range_without_return =
      is_silent_free ? std::min(longest, scan.free_range_without_return) : longest;
  for (double& range : cut.ranges) {
    if (isNoReturn(range) && !is_silent_free) {
      range = std::numeric_limits<double>::quiet_NaN();
    } else if (range > longest) {
      range = std::numeric_limits<double>::infinity();
    }
  }
  return cut;
}

}  // namespace cca
