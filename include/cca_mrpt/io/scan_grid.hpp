// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <memory>

#include "cca_mrpt/io/scan_raster.hpp"

namespace cca {

/// A ScanRaster that also stands in a grid of MRPT's, at any time: from 5 m around where the scans
/// begin on. Of no use farther than some kilometres from (0, 0): MRPT keeps its grid in floats.
class ScanGrid {
 public:
  /// @param p_begin  m: about where the scans begin; within 10 000 km, see localOrigin().
  explicit ScanGrid(const Eigen::Vector2d& p_begin = Eigen::Vector2d::Zero());

  /// See ScanRaster::insert().
  void insert(const Scan& scan);

  std::shared_ptr<const mrpt::maps::COccupancyGridMap2D> grid() const { return grid_; }
  /// All cells that were seen; nothing where none was.
  std::optional<OccupancyRaster> raster() const { return raster_.raster(); }

 private:
  void show(Cell cell);

  ScanRaster raster_;
  std::shared_ptr<mrpt::maps::COccupancyGridMap2D> grid_;
};

}  // namespace cca
