// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// Share of its range that a laser reports from which on a reading says "no return": drivers write
/// the largest range itself, and formats round it.
inline constexpr double kOfReach = 0.999;

/// Finds out which readings of a laser stand for "no return" where nothing else tells it: drivers
/// then write one of a few nearly equal values at the top of the scale (81.91 and 81.83, 51.1,
/// 32.767 m).
///
/// A scan shows such a value if readings like its largest one lie in more than four places, or
/// cover more than 15 degrees, among clearly nearer ones, outnumber those a little smaller, and are
/// two different numbers at the most. No surface does that: a flat one leaves them within 3.6
/// degrees of its perpendicular, and what stands at the same distance here and there is read with
/// noise. A largest
/// reading that stands alone is a sign as well where it stays while the robot moves: ten such scans
/// count as much as one of the others. A value that is exceeded as often as it is shown falls.
class Saturation {
 public:
  /// Cost: O(beams). Readings beyond kImpossible are left out.
  void add(const Scan& scan);

  /// m; readings from here on are no returns: 96 % of the value, for its codes differ; +infinity
  /// where all are returns.
  double threshold() const;

  /// m; no indoor laser reads that far: readings beyond are damage, not the top of a scale.
  static constexpr double kImpossible = 1000.0;

 private:
  int scoreOf(const Scan& scan, double largest);

  double value_ = 0.0;        ///< m, that may stand for no return
  int score_ = 0;             ///< what the scans said for it
  double last_median_ = 0.0;  ///< m, of the last scan that counted by what stood alone
};

}  // namespace cca
