// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <memory>
#include <optional>

#include "io/mrpt/mrpt_scan.hpp"

namespace cca {

/// Scans and odometry as MRPT's map builders take them: what the wheels did since the last scan,
/// and the scan.
class MrptSteps {
 public:
  struct Step {
    mrpt::obs::CActionCollection actions;
    mrpt::obs::CSensoryFrame frame;
  };

  /// @param T_odom_robot  empty, or empty the last time: the robot has not moved.
  Step next(const Scan& scan, const Pose2& T_robot_sensor,
            const std::optional<Pose2>& T_odom_robot) {
    const bool is_guided = last_odometry_ && T_odom_robot;
    const Pose2 moved = is_guided ? last_odometry_->inverse() * *T_odom_robot : Pose2();
    last_odometry_ = T_odom_robot;
    time_ += 0.1;
    mrpt::obs::CActionRobotMovement2D movement;
    movement.timestamp = mrpt::Clock::fromDouble(time_);
    movement.computeFromOdometry(mrpt::poses::CPose2D(moved.x, moved.y, moved.theta), {});
    Step step;
    step.actions.insert(movement);
    step.frame.insert(std::make_shared<mrpt::obs::CObservation2DRangeScan>(
        toMrpt(scan, T_robot_sensor, kMatchedRange, time_)));
    return step;
  }

 private:
  static constexpr double kMatchedRange = 1000.0;  // m; the points' own limit: no return is unknown

  std::optional<Pose2> last_odometry_;
  double time_ = 0.0;  ///< s; logs may lack it, and the builders insist that it rises
};

}  // namespace cca
