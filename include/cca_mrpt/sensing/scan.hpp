// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

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
  /// s, from beam 0 to the last: a laser that turns measures one beam after the other. Negative
  /// where the last beam was the first in time; 0 where all are of one instant. See undistort().
  double sweep_duration = 0.0;
  /// rad, of the beams' directions in the map, by the sensor's heading and by undistort(): 0 where
  /// the pose is exact and the beams are as they were measured.
  double bearing_sigma = 0.0;
  Pose2 T_map_sensor;  ///< in the middle of the sweep

  std::size_t size() const { return ranges.size(); }
  double bearing(std::size_t beam) const {
    return angle_min + static_cast<double>(beam) * angle_increment;
  }
  /// m, up to which the beam saw free space: its return, or how far it would have seen one; 0 where
  /// the range is invalid.
  double freeRange(std::size_t beam) const;
};

inline bool isReturn(double range) { return std::isfinite(range) && range > 0.0; }
inline bool isNoReturn(double range) { return std::isinf(range) && range > 0.0; }

inline double Scan::freeRange(std::size_t beam) const {
  const double range = ranges[beam];
  return isReturn(range) ? range : isNoReturn(range) ? free_range_without_return : 0.0;
}

/// The unit vectors of a scan's beams, beam after beam: each is the last one turned by the spacing,
/// and taken from sine and cosine anew now and then.
class TurningBeam {
 public:
  /// @param first_bearing, spacing  rad, of beam 0 and to the next; finite.
  TurningBeam(double first_bearing, double spacing)
      : first_bearing_(first_bearing),
        spacing_(spacing),
        turn_(std::cos(spacing), std::sin(spacing)) {}
  void turnTo(std::size_t beam) {
    if (beam == beam_ + 1 && --turns_left_ > 0) {
      const double cosine = cosine_, sine = sine_;
      cosine_ = cosine * turn_.x() - sine * turn_.y();
      sine_ = sine * turn_.x() + cosine * turn_.y();
    } else {
      aimAt(beam);
    }
    beam_ = beam;
  }
  // Of the bearing; two numbers, for a vector put together from them is slow to read at once.
  double cosine() const { return cosine_; }
  double sine() const { return sine_; }

 private:
  static constexpr int kTurnsPerSine =
      64;  // rotations add a rounding error each; it stays below 1e-14
  void aimAt(std::size_t beam);
  double first_bearing_, spacing_;
  Eigen::Vector2d turn_;
  double cosine_ = 1.0, sine_ = 0.0;
  std::size_t beam_ = 0;
  int turns_left_ = 0;
};

/// The returns of a scan as points, in counter-clockwise order.
struct ScanPoints {
  std::vector<Eigen::Vector2d> positions;  ///< m, sensor frame
  std::vector<int> beams;                  ///< beam of each point, counted from the cut on
  std::vector<int> silent;                 ///< beams without return, from the cut to each point
  std::vector<int> breaks;                 ///< beams without return and steps in depth, likewise
  int beam_count = 0;                      ///< of the scan
  int silent_in_all = 0;                   ///< beams without return of the whole scan
  double beam_spacing = 0.0;               ///< rad, > 0
  double point_sigma = 0.0;                ///< m, as given
  bool closed = false;                     ///< the last beam is a neighbour of the first

  std::size_t size() const { return positions.size(); }
  /// Beams without return between points i <= j.
  int silentBetween(int i, int j) const { return silent[j] - silent[i]; }
  /// The same, plus the steps in depth.
  int breaksBetween(int i, int j) const { return breaks[j] - breaks[i]; }
  /// Beams without return between the last point and the first of a closed scan.
  int silentAtSeam() const { return silent.front() + silent_in_all - silent.back(); }
};

/// Farther than any 2-D laser sees [m]; what claims to come from beyond is no return.
inline constexpr double kLongestRange = 1e4;

/// Takes the returns of a scan in counter-clockwise order.
///
/// A scan of a full turn has no first beam: the circle is cut after a missing return, else at the
/// sharpest bend of the ranges, so that the seam falls on a corner or a step in depth, not into the
/// middle of a wall.
/// @param point_sigma  m, deviation of a point from the surface that it saw: noise is no step in
/// depth.
/// @return  no points for a scan without returns, or with a spacing that is zero or not finite.
/// Cost: O(N).
ScanPoints scanPoints(const Scan& scan, double point_sigma = 0.0);

/// Lets a closed scan begin at point `first`.
void reopen(int first, ScanPoints* points);

}  // namespace cca
