// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/scan_grid.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"

namespace cca {

/// What goes into a map's folder beside the lines: the grid, and the way on which it was made.
struct MapRecord {
  ScanGrid grid;
  std::vector<Pose2> way;  ///< T_map_robot, a pose a scan; of the past only those kept

  void add(const Scan& scan, const Pose2& T_map_robot);
  /// A scan of another laser at about the same time.
  void addBeside(const Scan& scan) { grid.insert(scan); }
  /// Makes both anew of the scans kept.
  /// @param remembered  scans of it that are of an earlier drive, the first ones.
  void correct(const PastScans& past, std::size_t remembered = 0);
  /// A copy, which later scans do not change. @throws std::runtime_error where there is no scan
  /// yet.
  MapProducts products(const std::string& title, const LineMap& line_map) const;
};

}  // namespace cca
