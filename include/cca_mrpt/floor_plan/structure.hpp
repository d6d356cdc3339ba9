// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/floor_plan/components.hpp"
#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/mapping/wall.hpp"

namespace cca {

/// What tells furniture from the building.
struct StructureTuning {
  /// m; a free-standing obstacle of at most this extent is furniture whatever its lines: pillars
  /// and table legs alike part no rooms.
  double pillar = 1.0;
  /// m; one of at most this extent is furniture if none of its lines is as long as `pillar`: a ring
  /// of chairs, a plant with its shadow.
  double group = 2.5;
};

/// The building and what stands in it.
struct Structure {
  Mask solid;      ///< walls, what leans on them, and the unknown behind them
  Mask furniture;  ///< free-standing obstacles with the unknown inside of them
  Mask open;       ///< neither: seen free
};

/// The part of a grid that is known, with a margin of unknown cells around it. Empty where nothing
/// is known.
OccupancyRaster cropToKnown(const OccupancyRaster& grid, int margin_cells);

/// Parts obstacles into the building and free-standing furniture.
///
/// Cells that are not free, and those that a line crosses, are joined to components
/// (8-connected). What hangs together with the unknown outside is the building; an island is
/// furniture by its extent and its lines.
/// @param grid  cropToKnown(), at least one cell of margin.
/// Cost: O(cells + cells of the lines).
Structure tellStructure(const OccupancyRaster& grid, const std::vector<MapLine>& lines,
                        const StructureTuning& tuning = {});

/// Whether most cells of a line are solid: it belongs to the building, and to no furniture.
bool standsOn(const Mask& solid, const LineSegment& line);

}  // namespace cca
