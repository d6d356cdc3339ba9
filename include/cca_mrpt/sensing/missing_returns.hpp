// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/sensing/saturation.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// Learns what it means when a beam of this laser does not return, and judges each scan by it,
/// once, before anything else looks at it.
///
/// Saturated readings are no returns: those from kOfReach of the declared range on, and those that
/// Saturation finds.
///
/// A beam that is lost on a dark or grazed surface and one that leaves into the open read alike;
/// their neighbours tell them apart. A run of missing returns is open space only if
/// - it has more beams than beams lost at random make up, at the rate at which this laser loses
///   single ones, once in a thousand scans;
/// - at the range of its nearer neighbour it is wider than kNarrowestOpening.
/// Of any other run, each beam says nothing: it becomes invalid. (Where the laser declares no range
/// no beam without return says anything, and all stay as they are.)
///
/// A driver tells the largest range that it would report, not one up to which every surface is
/// seen: a laser of 80 m that loses its beam on dark cloth and glass three metres away has seen
/// nothing of 77 m of free space. Where beams are lost because all is further away than the laser
/// reaches, others end just within its reach: surfaces do not shun the last tenth of it. So open
/// space is believed to be free only where returns from that last tenth bear it out.
class MissingReturns {
 public:
  /// Judges a scan, which counts as evidence itself. A scan without any return is that of a covered
  /// or broken laser: it tells nothing, and teaches nothing.
  /// @param scan  as the driver gives it, free_range_without_return as it declares it; 0 where it
  ///              does not. Afterwards that is 0 unless missing returns are free space.
  /// Cost: O(beams).
  void judge(Scan& scan);

  /// m, at the range of the nearer neighbour; narrower ones may be a dark post or leg.
  static constexpr double kNarrowestOpening = 0.3;

 private:
  std::size_t leastBeams(std::size_t beams) const;
  void learnReach(Scan& scan, std::size_t open);

  Saturation saturation_;
  double lost_ = 0.0, beams_ = 0.0;   ///< single missing returns between two returns; all beams
  double missing_ = 0.0, far_ = 0.0;  ///< beams into the open; that came from far away
};

}  // namespace cca
