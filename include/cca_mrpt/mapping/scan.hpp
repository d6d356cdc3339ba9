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

inline bool isReturn(double range) {
  return std::isfinite(range) && range > 0.0;
}
inline bool isNoReturn(double range) {
  return std::isinf(range) && range > 0.0;
}

/// The returns of a scan as points, in order of rising bearing.
struct ScanPoints {
  std::vector<Eigen::Vector2d> positions;  ///< m, sensor frame
  std::vector<int> beams;                  ///< beam of each point, counted counter-clockwise
  std::vector<double> beam_ranges;         ///< m, every beam, counter-clockwise, from the cut on
  double beam_spacing = 0.0;               ///< rad, > 0

  std::size_t size() const { return positions.size(); }
};

/// Takes the returns of a scan in counter-clockwise order.
///
/// A scan of a full turn has no first beam: the circle is cut beside its largest step in range, so
/// that the seam falls on the edge of an object, never inside a wall that could have been avoided.
/// Of more beams than a turn holds, the surplus closes the circle and stays in place.
/// @return  no points for a scan without returns, or with a spacing that is zero or not finite.
/// Cost: O(N).
ScanPoints scanPoints(const Scan& scan);

}  // namespace cca
