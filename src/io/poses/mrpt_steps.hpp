// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <memory>
#include <optional>

#include "io/mrpt/mrpt_scan.hpp"

namespace cca {

/// What the wheels did since the last scan, and the scan.
struct MrptStep {
  mrpt::obs::CActionCollection actions;
  mrpt::obs::CSensoryFrame frame;
};

/// @param moved  T_last_now of the robot, by the wheels. @param max_range  m, see toMrpt().
/// @param time   s since 1970.
inline MrptStep mrptStep(const Pose2& moved, const Scan& scan, const Pose2& T_robot_sensor,
                         double max_range, double time) {
  mrpt::obs::CActionRobotMovement2D movement;
  movement.timestamp = mrpt::Clock::fromDouble(time);
  movement.computeFromOdometry(mrpt::poses::CPose2D(moved.x, moved.y, moved.theta), {});
  MrptStep step;
  step.actions.insert(movement);
  step.frame.insert(std::make_shared<mrpt::obs::CObservation2DRangeScan>(
      toMrpt(scan, T_robot_sensor, max_range, time)));
  return step;
}

/// Scans and odometry as MRPT's map builders take them.
class MrptSteps {
 public:
  /// @param T_odom_robot  empty, or empty the last time: the robot has not moved.
  MrptStep next(const Scan& scan, const Pose2& T_robot_sensor,
                const std::optional<Pose2>& T_odom_robot) {
    const bool is_guided = last_odometry_ && T_odom_robot;
    const Pose2 moved = is_guided ? last_odometry_->inverse() * *T_odom_robot : Pose2();
    last_odometry_ = T_odom_robot;
    time_ += 0.1;
    return mrptStep(moved, scan, T_robot_sensor, kMatchedRange, time_);
  }

 private:
  static constexpr double kMatchedRange = 1000.0;  // m; the points' own limit: no return is unknown

  std::optional<Pose2> last_odometry_;
  double time_ = 0.0;  ///< s; logs may lack it, and the builders insist that it rises
};

}  // namespace cca
