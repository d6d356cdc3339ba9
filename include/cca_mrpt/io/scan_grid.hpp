// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <memory>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// The occupancy grid that accompanies a line map: scans in MRPT's grid at 5 cm, from 5 m around
/// where they begin on. Of no use farther than some kilometres from (0, 0): it is kept in floats.
class ScanGrid {
 public:
  /// @param p_begin  m: about where the scans begin; within 10 000 km, see localOrigin().
  explicit ScanGrid(const Eigen::Vector2d& p_begin = Eigen::Vector2d::Zero());

  /// Takes a scan at its T_map_sensor. Beams without return free the space up to the scan's
  /// free_range_without_return, none where that is 0.
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

  std::shared_ptr<mrpt::maps::COccupancyGridMap2D> grid_;
};

}  // namespace cca
