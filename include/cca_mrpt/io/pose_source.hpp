// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cca_mrpt/io/icp_localizer.hpp"
#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// Where the poses of a map come from.
enum class PoseKind {
  kLog,       ///< corrected poses where the log has them, else its odometry
  kOdometry,  ///< the wheels alone
  kIcp,       ///< MRPT's ICP-SLAM, started from the odometry
  kTruth,     ///< of a simulation
  kSlam,      ///< line SLAM over the whole log (cca::Slam): no PoseSource gives it scan by scan
};

/// @throws std::runtime_error telling what is allowed: log, slam, odometry, icp, truth.
PoseKind poseKind(const std::string& name);

/// Gives every scan of a log its pose.
class PoseSource {
 public:
  /// @param kind  any but kSlam.
  explicit PoseSource(PoseKind kind, const IcpParameters& icp = {}) : kind_(kind), icp_(icp) {}

  /// @return  T_map_robot; odometry and ICP start where the log's own poses do. Where a scan has no
  ///          odometry, ICP takes it that the robot has stood still.
  /// @throws std::runtime_error where the log does not hold what is asked for.
  Pose2 locate(const LogRecord& record);

  /// locate(), and puts the scan there. A pose of the log's leaves the scan where the log has it,
  /// to the bit: so does who maps the same scans as they are played.
  /// @return  T_map_robot.
  Pose2 place(LogRecord& record);

  /// What had to be done without, for people; empty where all was well.
  std::string warnings() const;

 private:
  PoseKind kind_;
  IcpParameters icp_;
  std::optional<Pose2> T_map_odom_;
  std::optional<IcpLocalizer> localizer_;
  std::size_t unguided_ = 0;  ///< scans that ICP had no odometry for
};

/// T_map_robot of the scan as the log has it: corrected, else its odometry.
Pose2 logPose(const LogRecord& record);

/// The pose that a run can be judged by: the truth, else what a SLAM system had stored.
std::optional<Pose2> referencePose(const LogRecord& record);

}  // namespace cca
