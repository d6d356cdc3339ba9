// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/io/scan_grid.hpp"
#include "cca_mrpt/session/mapping_session.hpp"

namespace cca {

/// The occupancy grid of the scans that a map is made of.
class GridRecorder : public MapRecorder {
 public:
  /// @param p_begin  see ScanGrid.
  explicit GridRecorder(const Eigen::Vector2d& p_begin = Eigen::Vector2d::Zero())
      : p_begin_(p_begin), grid_(p_begin) {}

  void restart() override { grid_ = ScanGrid(p_begin_); }
  void record(const MappedScan& mapped, const LineMap& /*map*/) override {
    grid_.insert(mapped.scan);
  }
  const ScanGrid& grid() const { return grid_; }

 private:
  Eigen::Vector2d p_begin_;
  ScanGrid grid_;
};

}  // namespace cca
