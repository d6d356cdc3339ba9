// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// A log whose odometry is as of each scan. Beside a scan, loggers write the last odometry that
/// they have: where a laser is faster than the odometry, some scans in a row hold one pose, and the
/// next one leaps on. Here a pose is that of the first scan that shows it, and the scans that hold
/// it are between it and the next one, by their times.
///
/// What stays as it is: odometry that is fresh at nearly each scan while the robot moves, records
/// without time, records that tell the motion of their sweep, and the scans of a robot that stands:
/// a pose that is held for long is left one and a half times as long before the next one as
/// others are held.
std::unique_ptr<LogReader> withoutHeldOdometry(std::unique_ptr<LogReader> log);

}  // namespace cca
