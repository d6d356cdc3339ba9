// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/scan_grid.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr float kFirstReach = 5.0F;  // m
constexpr auto kSide = static_cast<float>(ScanRaster::kResolution);
// Probabilities of being free; MRPT keeps those nearest to them that its cells can hold.
constexpr float kSurelyFree = 1.0F, kSurelyOccupied = 0.0F, kOpen = 0.5F;

float freenessOf(Occupancy state) {
  if (state == Occupancy::kUnknown) return kOpen;
  return state == Occupancy::kFree ? kSurelyFree : kSurelyOccupied;
}

}  // namespace

ScanGrid::ScanGrid(const Eigen::Vector2d& p_begin) : raster_(p_begin) {
  const auto x = static_cast<float>(std::round(p_begin.x())),
             y = static_cast<float>(std::round(p_begin.y()));
  grid_ = std::make_shared<mrpt::maps::COccupancyGridMap2D>(
      x - kFirstReach, x + kFirstReach, y - kFirstReach, y + kFirstReach, kSide);
}

void ScanGrid::insert(const Scan& scan) {
  if (!raster_.insert(scan)) return;
  for (const Cell cell : raster_.cells().changed()) show(cell);
}

void ScanGrid::show(Cell cell) {
  const Eigen::Vector2f p = raster_.cells().centreOf(cell).cast<float>();
  if (p.x() < grid_->getXMin() || p.x() > grid_->getXMax() || p.y() < grid_->getYMin() ||
      p.y() > grid_->getYMax()) {
    const Eigen::Vector2f low = p - Eigen::Vector2f::Constant(kSide),
                          high = p + Eigen::Vector2f::Constant(kSide);
    grid_->resizeGrid(std::min(grid_->getXMin(), low.x()), std::max(grid_->getXMax(), high.x()),
                      std::min(grid_->getYMin(), low.y()), std::max(grid_->getYMax(), high.y()),
                      kOpen);
  }
  grid_->setPos(p.x(), p.y(), freenessOf(raster_.at(cell)));
}

}  // namespace cca
