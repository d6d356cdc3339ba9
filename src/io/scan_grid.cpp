// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/scan_grid.hpp"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

/// A beam without return reads longer than what is inserted: MRPT then frees its way, and no more.
mrpt::obs::CObservation2DRangeScan toObservation(const Scan& scan, float no_return) {
  mrpt::obs::CObservation2DRangeScan observation;
  observation.resizeScan(scan.size());
  const auto gaps = static_cast<double>(scan.size() - 1);
  observation.aperture = static_cast<float>(std::abs(scan.angle_increment) * gaps);
  observation.rightToLeft = scan.angle_increment > 0.0;
  observation.maxRange = no_return + 1.0F;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range = scan.ranges[beam];
    const bool frees = isNoReturn(range) && scan.free_range_without_return > 0.0;
    observation.setScanRangeValidity(beam, isReturn(range) || frees);
    observation.setScanRange(beam, isReturn(range) ? static_cast<float>(range) : no_return);
  }
  return observation;
}

}  // namespace

ScanGrid::ScanGrid()
    : grid_(std::make_shared<mrpt::maps::COccupancyGridMap2D>(-5.0F, 5.0F, -5.0F, 5.0F,
                                                              static_cast<float>(kResolution))) {
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
  grid_->insertionOptions.maxDistanceInsertion = static_cast<float>(longest);
  const auto observation = toObservation(scan, static_cast<float>(longest + 1.0));
  // MRPT's scans are symmetric about their x axis: the pose takes what is left.
  const double middle = scan.bearing(0) + scan.bearing(scan.size() - 1);
  const Pose2& pose = scan.T_map_sensor;
  grid_->insertObservation(
      observation, mrpt::poses::CPose3D(pose.x, pose.y, 0.0, pose.theta + 0.5 * middle, 0.0, 0.0));
}

}  // namespace cca
