// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "slam/tracking.hpp"

namespace cca {

/// Scans, some seconds, that decide without any motion.
inline constexpr int kStandingScans = 50;

/// Decides from scans in a row that contradict the map whether the robot is lost.
///
/// One such scan has seen people or the floor. Several of them, over a metre of way, say that the
/// robot is not where the map has it.
class ContradictionMonitor {
 public:
  /// Running mean of the agreement of scans, [0, 1]: among people all scans agree less.
  double usualAgreement() const { return usual_; }

  /// Whether a scan contradicts the map. One that has hardly anything in common with earlier scans
  /// does not.
  /// @param returns  of the scan.
  bool isContradiction(const LocalMatch& found, std::size_t returns) const;

  /// Whether a scan that may have been taken elsewhere agrees there about as well as usual, and
  /// clearly better than here.
  bool isClearlyBetter(const LocalMatch& there, const LocalMatch& here) const;

  /// Whether two scans agree about as well as usual.
  bool isUsual(const SightCount& sights) const;

  /// Takes the agreement of a scan into the running mean.
  /// @param step  since the last scan. A contradiction counts by it, so that a stay of some seconds
  ///              among people does not make contradiction usual.
  void learn(double agreement, bool contradicts, const Pose2& step);

  /// Adds a scan that contradicts the map.
  /// @param step  since the last scan, as the odometry has it.
  void add(const Pose2& step, const ScanSurface& surface);
  /// A scan has agreed with the map, or a new part of the graph begins.
  void clear() { run_ = {}; }

  /// Whether the contradictions since the last clear() say that the robot is lost.
  bool isLost() const;
  /// The scans that contradicted the map, in a row.
  const std::vector<ScanSurface>& scans() const { return run_.scans; }

 private:
  struct Run {
    std::vector<ScanSurface> scans;
    double way = 0.0;                ///< m
    double way_with_turns = 0.0;     ///< m, see wayWithTurns()
    Pose2 T_first_last;              ///< of these scans
    bool agrees_with_itself = true;  ///< the scans show one place: no people, no floor
    double usual = 0.0;              ///< usualAgreement() before it
  };
  double leastAgreement() const;

  double usual_ = 0.9;  ///< before anything is known
  Run run_;
};

}  // namespace cca
