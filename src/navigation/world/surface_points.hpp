// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// What one beam of a scan says of a surface. Places are in cells, map frame.
struct SurfacePoint {
  bool is_return = false;
  bool goes_on = false;    ///< the surface does, to the next beam's return
  Eigen::Vector2d place;   ///< of the return
  Eigen::Vector2d inside;  ///< at a given depth behind it, square to the surface
  /// Cosine of the angle between the beam and the line square to the surface; 0 where the return
  /// has no neighbour that tells of the surface's direction.
  double squareness = 0.0;
};

/// The surfaces that a scan saw, beam by beam.
///
/// Two neighbouring returns lie on one surface where they are a cell or four spacings of the beams
/// apart, or in line with a third one at a grazing angle. The last beam of a full turn is a
/// neighbour of the first. The direction of a surface is taken over two cells to each side; a
/// return without a neighbour faces the sensor.
///
/// @param directions  unit vectors of the beams, map frame.
/// @param resolution  m, side of a cell.
/// @param depth       cells.
/// @param farthest    cells; returns beyond are none.
/// Cost: O(beams), and the neighbours of each within two cells.
std::vector<SurfacePoint> surfacePoints(const Scan& scan,
                                        const std::vector<Eigen::Vector2d>& directions,
                                        double resolution, double depth, double farthest);

}  // namespace cca
