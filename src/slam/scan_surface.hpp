// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "cca_mrpt/sensing/analysed_scan.hpp"

namespace cca {

/// atan2 to 1e-5 rad, by the polynomial of Abramowitz & Stegun (1964), 4.4.49: a fifth of its time.
inline double bearingOf(const Eigen::Vector2d& p) {
  const double ax = std::abs(p.x()), ay = std::abs(p.y());
  const double larger = std::max(ax, ay);
  if (larger <= 0.0) return 0.0;
  const double z = std::min(ax, ay) / larger, zz = z * z;
  double angle =
      z * (0.9998660 + zz * (-0.3302995 + zz * (0.1801410 + zz * (-0.0851330 + zz * 0.0208351))));
  if (ay > ax) angle = M_PI_2 - angle;
  if (p.x() < 0.0) angle = M_PI - angle;
  return p.y() < 0.0 ? -angle : angle;
}

/// A return in single precision (two micrometres at 30 m).
struct PackedReturn {
  float x = 0.0F, y = 0.0F;                ///< m
  float normal_x = 0.0F, normal_y = 0.0F;  ///< unit; zero where no surface is known
};

/// Returns, one array for each coordinate: for loops over all of them at once.
struct PackedPoints {
  std::vector<float> x, y, normal_x, normal_y;

  std::size_t size() const { return x.size(); }
  void resize(std::size_t count) {
    for (std::vector<float>* column : {&x, &y, &normal_x, &normal_y}) column->resize(count);
  }
  PackedReturn at(std::size_t k) const { return {x[k], y[k], normal_x[k], normal_y[k]}; }
  void set(std::size_t k, const PackedReturn& single) {
    x[k] = single.x;
    y[k] = single.y;
    normal_x[k] = single.normal_x;
    normal_y[k] = single.normal_y;
  }
};

/// What one scan saw, ready to be compared with others: its returns with the direction of the
/// surface there, found again by their bearing. Everything is in the sensor's frame.
struct ScanSurface {
  struct Point {
    Eigen::Vector2d position;  ///< m
    Eigen::Vector2d normal;    ///< unit, towards the sensor; zero where no surface is known
    int beam = 0;
  };
  std::vector<Point> points;  ///< counter-clockwise
  PackedPoints packed;        ///< the same; see pack()
  /// The same by beam, of no normal where a beam has no return. At either end are kBeside more,
  /// those of the other end after a full turn: who asks beside a beam need not ask whether there is
  /// one.
  static constexpr int kBeside = 8;
  std::vector<PackedReturn> padded = std::vector<PackedReturn>(2 * kBeside);
  std::vector<int> point_of_beam;  ///< index into `points`; -1: no return
  std::vector<double> free_range;  ///< m, that each beam saw free; 0: it says nothing
  std::vector<float> least_free;   ///< m, of each beam and its two neighbours
  std::vector<float> most_free;    ///< m, of these
  double first_bearing = 0.0;      ///< rad, of beam 0
  double spacing = 0.0;            ///< rad, > 0; beams are counter-clockwise here
  double range_sigma = 0.0;        ///< m, of the returns (rangeNoise())
  bool is_full_turn = false;       ///< the last beam is a neighbour of the first

  int beams() const { return static_cast<int>(point_of_beam.size()); }
  /// Of beam 0; of others from -kBeside to beams() + kBeside - 1 as well.
  const PackedReturn* returns() const { return padded.data() + kBeside; }
  /// The beam that looks at a point of the sensor's frame, to the nearest; -1 where
  /// none does.
  int beamTowards(const Eigen::Vector2d& p_sensor) const;
  /// To be called when the points have changed.
  void pack();
};

inline int ScanSurface::beamTowards(const Eigen::Vector2d& p_sensor) const {
  const double turn = 2.0 * M_PI;
  double from_first = bearingOf(p_sensor) - first_bearing;
  if (from_first < -0.5 * spacing) from_first += turn;
  if (from_first < -0.5 * spacing) from_first += turn;
  if (from_first >= turn - 0.5 * spacing) from_first -= turn;
  const int beam = static_cast<int>(from_first / spacing + 0.5);
  return beam < beams() ? beam : is_full_turn ? 0 : -1;
}

/// Farther than this [m] a beam says more of the laser's angle than of the surface.
inline constexpr double kFarthestSurface = 30.0;

/// The surface that a scan saw. Normals are those of the scan's lines; a return on
/// no line has that of its nearest neighbours, where these lie on a line.
///
/// @param scan  any; T_map_sensor is not used.
/// @return      no points for a scan without returns or with a useless spacing.
/// Cost: O(N).
ScanSurface scanSurface(const AnalysedScan& analysed);
/// The same of a scan that nobody has analysed yet. Cost: that of analyse().
ScanSurface scanSurface(const Scan& scan);

}  // namespace cca
