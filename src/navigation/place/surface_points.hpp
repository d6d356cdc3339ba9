// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// What one beam of a scan says of a surface. Places are in cells, map frame.
struct SurfacePoint {
  bool is_return = false;
  bool goes_on = false;    ///< the surface does, straight to the next beam's return
  bool may_go_on = false;  ///< likewise, or to a return so near that it is likely
  Eigen::Vector2d place;   ///< of the return
  Eigen::Vector2d inside;  ///< at a given depth behind it, square to the surface
};

/// The surfaces that a scan saw, beam by beam.
///
/// A surface goes on to the next return where that is a cell away at most, or both are in line with
/// a third one, as on a wall at a grazing angle; it may go on where they are four spacings of the
/// beams apart: there may be a step. The last beam of a full turn is a neighbour of the first. The
/// direction of a surface is taken over two cells to each side; a
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
