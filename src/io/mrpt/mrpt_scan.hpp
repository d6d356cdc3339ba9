// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <optional>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

struct MountedScan {
  Scan scan;  ///< T_map_sensor is the identity
  Pose2 T_robot_sensor;
};

/// A scan of MRPT's. Beams that MRPT calls invalid are no returns (+inf) where their range is 0 or
/// reaches the laser's maximum, else invalid (0); valid ones from the maximum on are no returns.
/// Nothing is said of free space without a return: MRPT does not tell. Lasers mounted upside down
/// sweep mirrored.
/// @return  nothing for a laser tilted by more than 15 degrees, or a field of view that is none.
std::optional<MountedScan> fromMrpt(const mrpt::obs::CObservation2DRangeScan& observation);

/// The reverse. Beams without return are invalid and read max_range; invalid ones are invalid and
/// read a thousandth of it. MRPT's scans are symmetric about their x axis: what ours is not goes
/// into sensorPose.
/// @param max_range  m. @param time  s since 1970; nothing: no time stamp.
mrpt::obs::CObservation2DRangeScan toMrpt(const Scan& scan, const Pose2& T_robot_sensor,
                                          double max_range, std::optional<double> time = {});

}  // namespace cca
