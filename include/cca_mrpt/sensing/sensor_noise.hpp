// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// What the noise of a laser is, along and across its beams, learned from scan after scan. The
/// program has no noise parameter.
///
/// Along the beam: the mean of what rangeNoise() finds. Across: where a surface slants away from
/// the beams, an error of the bearing is one of the range, in proportion to the slope
/// |dr / dbearing|. The median of the deviations over the slope, among seven neighbours each that
/// look like one surface, is the bearing noise, once the range noise is taken off.
class SensorNoise {
 public:
  /// @param range_sigma  m, of rangeNoise(scan).
  /// Cost: O(beams), and O(kKept) where the scan shows a slanted surface.
  void add(const Scan& scan, double range_sigma);

  /// m, of a range; 0 before the first scan.
  double rangeSigma() const { return range_sigma_; }
  /// rad, of a beam's bearing; 0 until enough slanted surfaces were seen.
  double bearingSigma() const { return bearing_sigma_; }
  /// m^2, of the place of a return: the larger of what it may lie off along and across its beam.
  /// @param range  m.
  double variance(double range) const;

 private:
  static constexpr std::size_t kKept = 500;  // deviations: a median of so many is good to 6 %

  struct Deviation {
    double across;  ///< rad, as if all of it were the bearing's
    double along;   ///< rad, what the range noise makes of it
  };
  std::vector<Deviation> slanted(const Scan& scan) const;

  double range_sigma_ = 0.0, bearing_sigma_ = 0.0;
  std::size_t scans_ = 0, seen_ = 0;
  std::vector<Deviation> kept_;  ///< the last kKept
};

}  // namespace cca
