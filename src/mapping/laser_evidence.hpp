// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"
#include "mapping/map_clusters.hpp"

namespace cca {

/// Unit vectors of a scan's beams in the map frame.
std::vector<Eigen::Vector2d> beamDirections(const Scan& scan);

/// Whether a range is that of a return, and no farther than an indoor wall may be: 100 m.
bool isUsableReturn(double range);

/// Half-open range of beams.
struct BeamRange {
  std::size_t first = 0, last = 0;
};

/// The beams that can meet a stretch (map frame), within `off` [m] of it: one range, or two where
/// the stretch lies across the scan's seam or the last beams repeat the first; none where bearings
/// are not finite.
std::array<BeamRange, 2> beamsTowards(const Scan& scan, const Eigen::Vector2d& start,
                                      const Eigen::Vector2d& end, double off);

/// Enters each return of the scan as a hit of the wall that it came from: the wall of the new line
/// that it lies on, else the nearest wall that was hit there before, else none.
///
/// @param beams  as beamDirections() gives them.
/// @param lines  of the scan, in any order.
/// @param loose  where not null, takes the returns of no wall, m, map frame.
/// Cost: O(beams).
void depositReturns(const Scan& scan, const std::vector<Eigen::Vector2d>& beams,
                    const std::vector<NewLine>& lines, const MapNoise& noise, Walls& walls,
                    std::vector<Eigen::Vector2d>* loose = nullptr);

/// Counts each ray against the bins of the walls that it went clearly through: further behind them
/// than noise and pose error could feign. A ray without return counts against no wall: before a
/// dark surface it reads as into the open, and would refute all that stands behind that.
///
/// Cost: O(beams + cells of the rectangle that the rays span + beams towards each wall in them),
/// whatever the size of the map.
void passRays(const Scan& scan, const std::vector<Eigen::Vector2d>& beams, const MapNoise& noise,
              Walls& walls);

}  // namespace cca
