// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/mapping/map_line.hpp"
#include "floor_plan/components.hpp"

namespace cca {

/// What tells furniture from the building, and rooms from what was glimpsed.
struct StructureTuning {
  /// m; a free-standing obstacle of at most this extent is furniture whatever its lines: pillars
  /// and table legs alike part no rooms, unless walls lead up to them from two sides.
  double pillar = 1.0;
  /// m; below it what stands between walls is a leg, or a person, and what stands before a wall may
  /// be the stub of a wall beside a door.
  double thinnest_pillar = 0.35;
  /// m; one of at most this extent is furniture if none of its lines is as long as `pillar`: a ring
  /// of chairs, a plant with its shadow.
  double group = 2.5;
  /// m; open floor narrower than twice that is no place for a person: beams through a window, or
  /// between the leaves of a door, leave slits behind it.
  double half_slit = 0.25;
  /// m; unknown cells between two beams, up to twice that apart, are floor: nothing that parts a
  /// room and shows to neither beam is that narrow.
  double half_stripe = 0.1;
};

/// The building and what stands in it.
struct Structure {
  Mask solid;      ///< walls, what is built, and the unknown behind them
  Mask furniture;  ///< obstacles that stand free or before a wall, with the unknown inside of them
  Mask open;       ///< neither: seen free; what is in no mask is unknown floor between beams
};

/// The part of a grid that is known, with a margin of unknown cells around it. Empty where nothing
/// is known.
OccupancyRaster cropToKnown(const OccupancyRaster& grid, int margin_cells);

/// Parts obstacles into the building and free-standing furniture.
///
/// Cells that are not free, and those that a line crosses, are joined to components
/// (8-connected). What hangs together with the unknown outside is the building; an island is
/// furniture by its extent and its lines. A pillar that the lines of walls, of `pillar` and more,
/// lead up to from two sides is building: it stands between two openings of one wall. What is no
/// larger than a pillar and stands before a wall, whose line goes on behind it, is furniture.
/// @param grid  cropToKnown(), at least one cell of margin.
/// Cost: O(cells + cells of the lines + cells of islands x lines).
Structure tellStructure(const OccupancyRaster& grid, const std::vector<MapLine>& lines,
                        const StructureTuning& tuning = {});

/// Where rooms may be: open floor and what is under furniture, without slits.
/// @param clearance  m, distanceTransform(structure.solid). Cost: O(cells).
Mask spaceForRooms(const Structure& structure, const Raster<float>& clearance,
                   const StructureTuning& tuning = {});

/// Whether most cells of a line are solid: it belongs to the building, and to no furniture.
bool standsOn(const Mask& solid, const LineSegment& line);

}  // namespace cca
