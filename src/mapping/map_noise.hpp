// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace cca {

/// What misplaces a new line against the map, learned from the lines themselves.
///
/// The median of the magnitude of a normal variable is 0.6745 sigma: each innovation moves the
/// estimate a small step towards the side that it fell on. No outlier can pull it further than that
/// step, and nothing has to be stored. Deviation: the paper tunes its widths "dynamically" without
/// saying how; this is ours.
class MapNoise {
 public:
  /// @param offset       m, lateral distance of a line from the wall it belongs to.
  /// @param own_variance m^2, what range noise alone explains of it.
  void learnOffset(double offset, double own_variance);
  /// @param angle  rad, between the two; variance in rad^2.
  void learnAngle(double angle, double own_variance);
  /// @param variance  m^2, of one return across its line. @param distance  m, of the line.
  void learnRange(double variance, double distance);

  double offsetVariance() const { return offset_ * offset_; }
  double angleVariance() const { return angle_ * angle_; }
  /// The same without the least that they are taken to be where lines are compared.
  double ownOffsetVariance() const { return own_offset_ * own_offset_; }
  double ownAngleVariance() const { return own_angle_ * own_angle_; }
  double rangeVariance() const { return of_all_.variance; }
  /// Variance [m^2] of a return across its line, of lines in the octave of that distance [m], > 0,
  /// or in the next nearer one of which enough is known: not below that of all.
  double rangeVariance(double distance) const;
  /// Standard deviation [m] of one return across the wall it belongs to.
  double lateralSigma() const;
  /// Variance [m^2] of the same for a return that was seen `range` [m] away, > 0, by the lines that
  /// were seen in its octave of distance, or in the next nearer one of which enough is known: not
  /// below that of all returns. Lasers that triangulate err by a share of the range.
  double lateralVariance(double range) const;

 private:
  struct Median {
    double variance = 0.0, samples = 0.0;
    void learn(double value);
  };
  static constexpr std::size_t kOctaves = 8;  // of distance, the last one from 32 m on
  static std::size_t octaveOf(double distance);

  double offset_ = 0.03, angle_ = 0.01;  // a usual localisation, until the data speak
  double own_offset_ = 0.03, own_angle_ = 0.01;
  Median of_all_;
  std::array<Median, kOctaves> of_octave_;
  double offsets_ = 0.0, angles_ = 0.0;
};

}  // namespace cca
