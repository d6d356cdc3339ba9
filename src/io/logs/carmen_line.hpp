// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

enum class CarmenMessage { kFrontLaser, kRearLaser, kRobotLaser, kRawLaser, kRawRearLaser };

/// One laser line of a CARMEN log (FLASER, RLASER, ROBOTLASER1, ROBOTLASER2, RAWLASER1, RAWLASER2)
/// as it is written; readings are not judged here.
struct CarmenScan {
  CarmenMessage message = CarmenMessage::kFrontLaser;
  std::vector<double> ranges;    ///< m
  double angle_min = 0.0;        ///< rad
  double angle_increment = 0.0;  ///< rad
  double max_range = 0.0;        ///< m; 0 where the line does not tell
  Pose2 laser;                   ///< as written
  Pose2 robot;                   ///< as written: odometry, unless a SLAM program rewrote the log
  std::optional<double> time;    ///< s
};

/// An ODOM line.
struct CarmenOdometry {
  Pose2 T_odom_robot;
  std::optional<double> time;  ///< s
};

/// Reads a laser line.
///
/// FLASER and RLASER tell no angles: the SICK's conventions hold, first beam at -90 degrees, 180 or
/// 181 beams 1 degree apart, 360 or 361 beams 0.5 degrees (90/91: 2, 720/721: 0.25, any other
/// number n: 180 / (n - 1)). So 180 beams end at +89 degrees. ROBOTLASER lines tell theirs.
/// An RLASER whose pose looks ahead carries the robot's pose; it is turned to look back. RAWLASER
/// lines carry no pose: the first is CARMEN's front laser, the second its rear one.
///
/// @return nothing where the line is none, is incomplete, or a pose is not finite.
std::optional<CarmenScan> parseCarmenScan(std::string_view line);

/// An ODOM line; nothing where the line is none or is incomplete.
std::optional<CarmenOdometry> parseCarmenOdometry(std::string_view line);

/// Whether the line starts as a laser line does, complete or not.
bool isCarmenScan(std::string_view line);

/// The first word of a line of a laser that CARMEN's logs place nowhere on the robot: LASER3,
/// LASER4, RAWLASER3, RAWLASER4, RAWLASER5. Empty for all others.
std::string_view unplacedLaser(std::string_view line);

/// Whether the line starts with one of the words that CARMEN's logger writes.
bool isCarmenLine(std::string_view line);

}  // namespace cca
