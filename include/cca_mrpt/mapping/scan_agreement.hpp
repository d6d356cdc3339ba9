// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

class Walls;

/// What the walls of a map have to say to the returns of a scan.
struct ScanVerdict {
  int confirmed = 0;     ///< returns that lie on a wall
  int contradicted = 0;  ///< returns from behind a wall: the ray went through it
};

/// Compares a scan with what the map predicts there. Returns that lie neither on a wall nor behind
/// one (clutter, people, what is new) say nothing; no more do beams without return. The tolerance
/// is not learned: a map that is made of wrong poses would learn to tolerate them.
///
/// @param walls  as they were before the scan was inserted.
/// Cost: O(beams looked at, 90 at most, times the cells of the wall index that each crosses).
ScanVerdict compareWithMap(const Scan& scan, const Walls& walls);

/// How far scans and map agree: of the returns that the map has something to say to, the share that
/// it does not contradict. 1 where it had nothing to say yet.
///
/// With poses that err by up to 5 cm and a degree it stays above kPoorAgreement, whatever the
/// place; a lost pose, or scans that are not what they are taken for, bring it below
/// (docs/ros_faults.md).
class ScanAgreement {
 public:
  void add(const ScanVerdict& verdict);
  /// Over the last five hundred scans or so.
  double recent() const;
  /// Over all.
  double overall() const;

 private:
  struct Sums {
    double confirmed = 0.0, contradicted = 0.0;
    double share() const;
  };
  Sums recent_, overall_;
};

/// Below it scans and map contradict each other. The logs of real robots stay above 0.998 at sound
/// poses; wheels that bend by 5 degrees a metre come to between 0.97 and 0.99 within one lap.
inline constexpr double kPoorAgreement = 0.99;

// Of the rays that are compared with a map or a plan.
/// m; further out a degree of heading is a quarter of a metre.
inline constexpr double kFarthestCompared = 15.0;
/// m, before the sensor: the robot itself is there, and its place errs by so much.
inline constexpr double kBlindCompared = 0.1;
/// m, of the end of a wall, which a ray may well miss.
inline constexpr double kRimOfWall = 0.15;

}  // namespace cca
