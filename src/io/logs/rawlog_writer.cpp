// SPDX-License-Identifier: BSD-3-Clause
#include "io/logs/rawlog_writer.hpp"

#include <algorithm>

#include "io/poses/mrpt_steps.hpp"

namespace cca {

RawlogWriter::RawlogWriter(const std::string& path, double max_range)
    : file_(path), max_range_(max_range) {}

void RawlogWriter::insert(const Scan& scan, const Pose2& T_robot_sensor, const Pose2& T_odom_robot,
                          double time) {
  time = std::max(0.0, time);  // MRPT's stamps have no sign
  const Pose2 moved = last_ ? last_->inverse() * T_odom_robot : T_odom_robot;
  last_ = T_odom_robot;
  const MrptStep step = mrptStep(moved, scan, T_robot_sensor, max_range_, time);
  file_.write(step.actions);
  file_.write(step.frame);
}

void RawlogWriter::commit() { file_.commit(); }

}  // namespace cca
