// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/scan_grid.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/io/mrpt_scan.hpp"

namespace cca {

constexpr float kFirstReach = 5.0F;  // m

ScanGrid::ScanGrid(const Eigen::Vector2d& p_begin) {
  const auto x = static_cast<float>(std::round(p_begin.x())),
             y = static_cast<float>(std::round(p_begin.y()));
  grid_ = std::make_shared<mrpt::maps::COccupancyGridMap2D>(x - kFirstReach, x + kFirstReach,
                                                            y - kFirstReach, y + kFirstReach,
                                                            static_cast<float>(kResolution));
  grid_->insertionOptions.considerInvalidRangesAsFreeSpace = false;
  grid_->insertionOptions.wideningBeamsWithDistance = false;
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
  const double free_range = scan.free_range_without_return;
  const double longest = free_range > 0.0 ? std::min(kLongestBeam, free_range) : kLongestBeam;
  auto observation = toMrpt(scan, {}, longest + 1.0);
  // A valid beam that reads longer than what is inserted frees its way and marks no obstacle.
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (free_range > 0.0 && isNoReturn(scan.ranges[beam])) {
      observation.setScanRangeValidity(beam, true);
    }
  }
  grid_->insertionOptions.maxDistanceInsertion = static_cast<float>(longest);
  const Pose2& pose = scan.T_map_sensor;
  grid_->insertObservation(observation,
                           mrpt::poses::CPose3D(pose.x, pose.y, 0.0, pose.theta, 0.0, 0.0));
}

}  // namespace cca
