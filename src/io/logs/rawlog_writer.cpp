// SPDX-License-Identifier: BSD-3-Clause
#include "io/logs/rawlog_writer.hpp"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>

#include "io/mrpt/mrpt_scan.hpp"

namespace cca {
namespace {

mrpt::obs::CActionCollection wheels(const Pose2& moved, double time) {
  mrpt::obs::CActionRobotMovement2D movement;
  movement.timestamp = mrpt::Clock::fromDouble(time);
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  movement.computeFromOdometry(mrpt::poses::CPose2D(moved.x, moved.y, moved.theta), model);
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  return actions;
}

}  // namespace

RawlogWriter::RawlogWriter(const std::string& path, double max_range)
    : file_(path), max_range_(max_range) {}

void RawlogWriter::insert(const Scan& scan, const Pose2& T_robot_sensor, const Pose2& T_odom_robot,
                          double time) {
  time = std::max(0.0, time);  // MRPT's stamps have no sign
  const Pose2 moved = last_ ? last_->inverse() * T_odom_robot : T_odom_robot;
  last_ = T_odom_robot;
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<mrpt::obs::CObservation2DRangeScan>(
      toMrpt(scan, T_robot_sensor, max_range_, time)));
  file_.write(wheels(moved, time));
  file_.write(frame);
}

void RawlogWriter::commit() { file_.commit(); }

}  // namespace cca
