// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <memory>

#include "cca_mrpt/navigation/world/exploration_grid.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// The occupancy grid that accompanies a line map: the grid by which exploration decides, as MRPT
/// and map files hold it, from 5 m around where the scans begin on. Occupied are also cells of a
/// wall between two returns; cells between two beams, presumed free, are unknown. Of no use farther
/// than some kilometres from (0, 0): MRPT keeps its grid in floats.
class ScanGrid {
 public:
  /// @param p_begin  m: about where the scans begin; within 10 000 km, see localOrigin().
  explicit ScanGrid(const Eigen::Vector2d& p_begin = Eigen::Vector2d::Zero());

  /// Takes a scan at its T_map_sensor, see ExplorationGrid::insert(). Beams without return free the
  /// space up to the scan's free_range_without_return, none where that is 0.
  /// Scans that would stretch the grid beyond kMostCells (a broken pose) are left out.
  void insert(const Scan& scan);

  std::shared_ptr<const mrpt::maps::COccupancyGridMap2D> grid() const { return grid_; }
  /// The grid as it is now, which later scans do not change.
  std::shared_ptr<const mrpt::maps::COccupancyGridMap2D> copy() const {
    return std::make_shared<mrpt::maps::COccupancyGridMap2D>(*grid_);
  }

  static constexpr double kResolution = 0.05;   ///< m
  static constexpr double kLongestBeam = 25.0;  ///< m; beyond, a beam's footprint exceeds a cell
  static constexpr double kMostCells = 1e8;

 private:
  bool fits(const Scan& scan) const;
  void show(Cell cell);

  ExplorationGrid cells_{kResolution};
  std::shared_ptr<mrpt::maps::COccupancyGridMap2D> grid_;
};

}  // namespace cca
