// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// Something on the plane, and how much it counts for.
struct WeightedPlace {
  Eigen::AlignedBox2d box;  ///< m
  double weight = 0.0;      ///< >= 0
};

/// Which of them have gone astray (a broken pose, and what was seen from it). Places are one group
/// as long as no gap along an axis is wider than 200 m, more than a laser looks over. Beside the
/// heaviest group, one is astray with less than a twentieth of the whole weight, or more than 10 km
/// away: a building is a pixel there of any picture that shows both.
/// @return  one for each place. Cost: O(n log n).
std::vector<bool> findStrays(const std::vector<WeightedPlace>& places);

/// The same for the poses of a robot's way.
std::vector<bool> findStrays(const std::vector<Pose2>& trajectory);

/// m, from pose to pose of those that have not gone astray. Cost: that of findStrays().
double drivenLength(const std::vector<Pose2>& trajectory);

}  // namespace cca
