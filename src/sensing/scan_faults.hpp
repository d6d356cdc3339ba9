// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// What is wrong with a scan as a whole.
enum class ScanFault {
  kNone,
  kRepeated,    ///< equal to the one before, beam by beam, though the wheels have gone on
  kMillimetres  ///< its ranges are far too long for metres
};

/// m; no robot drives where half of what its laser sees is farther. As millimetres it is 0.2 m.
inline constexpr double kLongestMedian = 200.0;

/// m, the median return; 0 where there is none. Cost: O(beams).
double medianReturn(const Scan& scan);

/// Tells scans that are no evidence of anything, of one laser.
class ScanFaults {
 public:
  /// @param T_odom_robot  nothing where the wheels do not tell: then no scan is called repeated.
  /// Cost: O(beams).
  ScanFault check(const Scan& scan, const std::optional<Pose2>& T_odom_robot);

 private:
  std::vector<double> ranges_;         ///< of the last scan
  std::optional<Pose2> T_odom_robot_;  ///< of the first scan that was like it
};

}  // namespace cca
