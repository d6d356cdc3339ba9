// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/scan_grid.hpp"

#include <algorithm>
#include <cmath>

#include "io/logs/scan_cut_off.hpp"

namespace cca {
namespace {

constexpr float kFirstReach = 5.0F;  // m
// Probabilities of being free; MRPT keeps those nearest to them that its cells can hold.
constexpr float kSurelyFree = 1.0F, kSurelyOccupied = 0.0F, kOpen = 0.5F;

float freenessOf(CellState state) {
  switch (state) {
    case CellState::kFree:
      return kSurelyFree;
    case CellState::kOccupied:
    case CellState::kPresumedWall:
      return kSurelyOccupied;
    default:
      return kOpen;
  }
}

static_assert(ScanGrid::kLongestBeam == kLongestGridBeam);

}  // namespace

ScanGrid::ScanGrid(const Eigen::Vector2d& p_begin) {
  const auto x = static_cast<float>(std::round(p_begin.x())),
             y = static_cast<float>(std::round(p_begin.y()));
  grid_ = std::make_shared<mrpt::maps::COccupancyGridMap2D>(x - kFirstReach, x + kFirstReach,
                                                            y - kFirstReach, y + kFirstReach,
                                                            static_cast<float>(kResolution));
}

bool ScanGrid::fits(const Scan& scan) const {
  const Pose2& pose = scan.T_map_sensor;
  const double width = std::max<double>(grid_->getXMax(), pose.x + kLongestBeam) -
                       std::min<double>(grid_->getXMin(), pose.x - kLongestBeam);
  const double height = std::max<double>(grid_->getYMax(), pose.y + kLongestBeam) -
                        std::min<double>(grid_->getYMin(), pose.y - kLongestBeam);
  return width * height / (kResolution * kResolution) <= kMostCells;
}

void ScanGrid::insert(const Scan& scan) {
  if (scan.size() < 2 || !fits(scan)) return;
  cells_.insert(cutOff(scan));
  for (const Cell cell : cells_.changed()) show(cell);
}

void ScanGrid::show(Cell cell) {
  const Eigen::Vector2f p = cells_.centreOf(cell).cast<float>();
  if (p.x() < grid_->getXMin() || p.x() > grid_->getXMax() || p.y() < grid_->getYMin() ||
      p.y() > grid_->getYMax()) {
    const auto side = static_cast<float>(kResolution);
    const Eigen::Vector2f low = p - Eigen::Vector2f::Constant(side),
                          high = p + Eigen::Vector2f::Constant(side);
    grid_->resizeGrid(std::min(grid_->getXMin(), low.x()), std::max(grid_->getXMax(), high.x()),
                      std::min(grid_->getYMin(), low.y()), std::max(grid_->getYMax(), high.y()),
                      kOpen);
  }
  grid_->setPos(p.x(), p.y(), freenessOf(cells_.at(cell)));
}

}  // namespace cca
