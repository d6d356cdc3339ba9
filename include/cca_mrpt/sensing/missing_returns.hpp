// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// Learns what it means when a beam of this laser does not return.
///
/// A driver tells the largest range that it would report, not one up to which every surface is
/// seen: a laser of 80 m that loses its beam on dark cloth and glass three metres away has seen
/// nothing of 77 m of free space. Where beams are lost because all is further away than the laser
/// reaches, others end just within its reach: surfaces do not shun the last tenth of it. So a
/// missing return is believed to tell of free space only where returns from that last tenth bear it
/// out.
class MissingReturns {
 public:
  /// Counts the scan's beams, and sets its free_range_without_return to 0 unless what has been seen
  /// up to now bears it out. A scan without any return is that of a covered or broken laser: it
  /// tells nothing, and teaches nothing.
  /// @param scan  free_range_without_return as the laser declares it. Cost: O(beams).
  void judge(Scan& scan);

 private:
  double missing_ = 0.0, far_ = 0.0;  ///< beams that did not return; that came from far away
};

}  // namespace cca
