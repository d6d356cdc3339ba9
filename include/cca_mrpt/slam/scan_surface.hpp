// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// What one scan saw, ready to be compared with others: its returns with the direction of the
/// surface there, found again by their bearing. Everything is in the sensor's frame.
struct ScanSurface {
  struct Point {
    Eigen::Vector2d position;  ///< m
    Eigen::Vector2d normal;    ///< unit, towards the sensor; zero where no surface is known
    int beam = 0;
  };
  std::vector<Point> points;       ///< counter-clockwise
  std::vector<int> point_of_beam;  ///< index into `points`; -1: no return
  std::vector<double> free_range;  ///< m, that each beam saw free; 0: it says nothing
  double first_bearing = 0.0;      ///< rad, of beam 0
  double spacing = 0.0;            ///< rad, > 0; beams are counter-clockwise here
  double range_sigma = 0.0;        ///< m, of the returns (rangeNoise())
  bool is_full_turn = false;       ///< the last beam is a neighbour of the first

  int beams() const { return static_cast<int>(point_of_beam.size()); }
  /// The beam that looks at a point of the sensor's frame, to the nearest; -1 where
  /// none does.
  int beamTowards(const Eigen::Vector2d& p_sensor) const;
};

/// Farther than this [m] a beam says more of the laser's angle than of the surface.
inline constexpr double kFarthestSurface = 30.0;

/// The surface that a scan saw. Normals are those of the scan's lines (extractLines()); a return on
/// no line has that of its nearest neighbours, where these lie on a line.
///
/// @param scan  any; T_map_sensor is not used.
/// @return      no points for a scan without returns or with a useless spacing.
/// Cost: that of extractLines(), and O(N) more.
ScanSurface scanSurface(const Scan& scan, const CcaParameters& parameters = {});

}  // namespace cca
