// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "cca_mrpt/mapping/pose2.hpp"

namespace cca {

/// One sweep of a 2-D laser, and where it was taken.
///
/// A range is a return (finite and positive), no return (+inf, as REP-117 has it), or invalid
/// (anything else: NaN, -inf, zero, negative), and then it is neither end point nor free space.
struct Scan {
  std::vector<double> ranges;    ///< m, beam by beam, counter-clockwise where angle_increment > 0
  double angle_min = 0.0;        ///< rad, bearing of beam 0 in the sensor frame
  double angle_increment = 0.0;  ///< rad, between neighbouring beams; negative: clockwise
  /// m; a beam without return is known to be free up to here. 0 where a missing return says
  /// nothing (glass, black cloth, or a log that does not tell).
  double free_range_without_return = 0.0;
  Pose2 T_map_sensor;

  std::size_t size() const { return ranges.size(); }
  double bearing(std::size_t beam) const {
    return angle_min + static_cast<double>(beam) * angle_increment;
  }
};

inline bool isReturn(double range) { return std::isfinite(range) && range > 0.0; }
inline bool isNoReturn(double range) { return std::isinf(range) && range > 0.0; }

}  // namespace cca
