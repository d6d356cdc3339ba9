// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/Range.h>

#include <Eigen/Core>
#include <vector>

namespace cca {

/// m; what is farther is told again before the robot is there. (A bumper that nobody touches is
/// told as a point a hundred metres away by some drivers.)
inline constexpr double kFarthestHazard = 3.0;

/// What bumpers, cliff sensors and the like have met: the points of a cloud that are finite and not
/// beyond kFarthestHazard. m, in the frame of the message.
/// @throws std::runtime_error for a cloud without x, y, z of 32 bits each, with fewer bytes than it
///         says, or with the bytes of a number the other way round.
std::vector<Eigen::Vector3d> hazardPoints(const sensor_msgs::PointCloud2& message);

/// The same of a distance sensor that looks along x: an arc over its field of view, 4 cm from point
/// to point. None where it saw nothing (+inf, NaN, beyond the limits or kFarthestHazard); at
/// min_range for -inf, which a sensor says that tells no distance.
/// @throws std::runtime_error for limits that are none, or a field of view of more than half a
///         turn.
std::vector<Eigen::Vector3d> hazardPoints(const sensor_msgs::Range& message);

}  // namespace cca
