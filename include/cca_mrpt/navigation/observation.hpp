// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cca_mrpt/motion/robot.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// What the robot knows at one moment.
struct Observation {
  Scan scan;  ///< taken at scan.T_map_sensor
  Pose2 T_map_robot;
  Velocity velocity;  ///< as measured
  double time = 0.0;  ///< s, never falling
  /// Whether T_map_robot is known. Where it is not, the robot drives on by its wheels and what it
  /// sees, and nothing is added to the map.
  bool is_localised = true;
  /// m, map frame: what other sensors see of what the laser may see, too (other lasers). The robot
  /// does not drive into it.
  std::vector<Eigen::Vector2d> seen_elsewhere{};
  /// m, map frame: what no laser sees (bumpers, cliff sensors). Paths lead around it, too.
  std::vector<Eigen::Vector2d> hazards{};
  /// m, of the scan's ranges; empty where nobody has analysed it yet, see AnalysedScan.
  std::optional<double> range_sigma{};

  double rangeSigma() const { return range_sigma ? *range_sigma : rangeNoise(scan).range_sigma; }
};

/// What has become of a goal that somebody else was to drive to.
enum class DriveOutcome { kReached, kFailed };

}  // namespace cca
