// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/localisation/localiser.hpp"

namespace cca {

/// Where the poses of a map come from.
enum class PoseSource {
  kLog,       ///< corrected poses where the log has them, else its odometry
  kOdometry,  ///< the wheels alone
  kIcp,       ///< MRPT's ICP-SLAM, started from the odometry
  kTruth,     ///< of a simulation
  kSlam,      ///< line SLAM
};

/// As people name them.
inline constexpr std::pair<const char*, PoseSource> kPoseSourceNames[] = {
    {"log", PoseSource::kLog},
    {"odometry", PoseSource::kOdometry},
    {"icp", PoseSource::kIcp},
    {"truth", PoseSource::kTruth},
    {"slam", PoseSource::kSlam}};
const char* nameOf(PoseSource source);

/// @throws std::runtime_error telling what is allowed: one of kPoseSourceNames.
PoseSource poseSource(const std::string& name);

/// What a localiser of that source is given of a log's scan: the pose that is asked for, or the one
/// that a drive begins at and is judged by. A pose of the log's leaves the scan where the log has
/// it, to the bit: so does who maps the same scans as they are played.
/// @throws std::runtime_error where the log does not hold what the source needs.
Measurement measurementOf(LogRecord record, PoseSource source);

/// T_map_robot of the scan as the log has it: corrected, else its odometry.
Pose2 logPose(const LogRecord& record);

/// The pose that a run can be judged by: the truth, else what a SLAM system had stored.
std::optional<Pose2> referencePose(const LogRecord& record);

}  // namespace cca
