// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/navigation/world/exploration_grid.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// The occupancy of the places that scans have seen: the grid by which exploration decides.
/// Occupied are also cells of a wall between two returns; cells between two beams, presumed free,
/// are unknown.
class ScanRaster {
 public:
  /// @param p_begin  m: about where the scans begin; nothing: where the first one is.
  explicit ScanRaster(const std::optional<Eigen::Vector2d>& p_begin = {});

  /// Takes a scan at its T_map_sensor, see ExplorationGrid::insert(). Beams without return free the
  /// space up to the scan's free_range_without_return, none where that is 0.
  /// @return  false where it was left out: it has fewer than two beams, or would stretch the raster
  ///          beyond kMostCells (a broken pose).
  bool insert(const Scan& scan);

  const ExplorationGrid& cells() const { return cells_; }
  /// What is known of a cell, as maps are saved.
  Occupancy at(Cell cell) const;
  /// All cells that were seen, in the scans' frame; nothing where none was.
  std::optional<OccupancyRaster> raster() const;

  static constexpr double kResolution = 0.05;  ///< m
  static constexpr double kMostCells = 1e8;    ///< 500 m x 500 m: 100 MB as a picture

 private:
  ExplorationGrid cells_{kResolution};
  Eigen::AlignedBox2d reached_;  ///< m: what beams of the scans may have reached
};

}  // namespace cca
