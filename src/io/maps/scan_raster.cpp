// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/scan_raster.hpp"

#include <algorithm>
#include <limits>

namespace cca {
namespace {

constexpr double kLongestGridBeam = 25.0;  // m; beyond, its footprint exceeds a cell

/// The scan up to kLongestGridBeam: what returns from beyond is free up to there.
Scan cutOff(const Scan& scan) {
  Scan cut = scan;
  const bool is_silent_free = scan.free_range_without_return > 0.0;
  cut.free_range_without_return = is_silent_free
                                      ? std::min(kLongestGridBeam, scan.free_range_without_return)
                                      : kLongestGridBeam;
  for (double& range : cut.ranges) {
    if (isNoReturn(range) && !is_silent_free) {
      range = std::numeric_limits<double>::quiet_NaN();
    } else if (range > kLongestGridBeam) {
      range = std::numeric_limits<double>::infinity();
    }
  }
  return cut;
}

}  // namespace

ScanRaster::ScanRaster(const std::optional<Eigen::Vector2d>& p_begin) {
  if (p_begin) reached_.extend(*p_begin);
}

bool ScanRaster::insert(const Scan& scan) {
  const Eigen::Vector2d p = scan.T_map_sensor.position();
  if (scan.size() < 2 || !cells_.covers(p)) return false;
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(kLongestGridBeam);
  const Eigen::AlignedBox2d reached = reached_.merged(Eigen::AlignedBox2d(p - reach, p + reach));
  if (reached.volume() > kMostCells * kResolution * kResolution) return false;
  reached_ = reached;
  cells_.insert(cutOff(scan));
  return true;
}

Occupancy ScanRaster::at(Cell cell) const {
  switch (cells_.at(cell)) {
    case CellState::kFree:
      return Occupancy::kFree;
    case CellState::kOccupied:
    case CellState::kPresumedWall:
      return Occupancy::kOccupied;
    default:
      return Occupancy::kUnknown;
  }
}

std::optional<OccupancyRaster> ScanRaster::raster() const {
  const Cell low = cells_.lowest(), high = cells_.highest();
  if (high.x < low.x || high.y < low.y) return std::nullopt;
  OccupancyRaster raster;
  raster.resolution = cells_.resolution();
  raster.columns = high.x - low.x + 1;
  raster.rows = high.y - low.y + 1;
  raster.origin = raster.resolution * Eigen::Vector2d(low.x, low.y);
  raster.values.reserve(static_cast<std::size_t>(raster.columns) *
                        static_cast<std::size_t>(raster.rows));
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) raster.values.push_back(at({x, y}));
  }
  return raster;
}

}  // namespace cca
