// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/geometry/polygon.hpp"
#include "cca_mrpt/mapping/map_line.hpp"
#include "floor_plan/room_regions.hpp"

namespace cca {

struct OutlineTuning {
  double snap = 0.16;       ///< m; a side of a cell stands for a line within three cells of 5 cm
  double bridge = 0.35;     ///< m of the border, or from it, that two lines close: a corner
  double notch = 1.0;       ///< m of one line that a shadow hides: the wall goes on behind it
  double tolerance = 0.06;  ///< m; cells of 5 cm stand off a straight side by less
};

/// Draws a chain of cell corners along the lines that it stands for.
///
/// Each side of a cell goes to the nearest line that is seen from its left, or to the opening that
/// it crosses; lines that follow each other meet in their corner. What has no line is
/// straightened.
/// @param chain  in cells, as of outlinesOfRegions(). @param lines  faces of walls.
/// @param openings  borders of the room, as segments.
/// @return  m, map frame. Simple where the chain is, but for errors of the lines above `snap`.
Polygon outlineAlongLines(const Raster<int>& labels, const Polygon& chain,
                          const std::vector<MapLine>& lines, const std::vector<Passage>& openings,
                          const OutlineTuning& tuning = {});

/// A ring without the loops of at most so many corners that it makes where it crosses itself:
/// errors of lines turn narrow steps inside out. Double corners and spikes go, too. Cost: O(n
/// most_corners) for each that goes.
Polygon withoutSmallLoops(Polygon ring, std::size_t most_corners = 6);

/// A chain straightened by at most `tolerance` [Douglas & Peucker 1973]; simple where it was.
Polygon straightened(const Raster<int>& labels, const Polygon& chain, double tolerance);

}  // namespace cca
