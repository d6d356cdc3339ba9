// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// Reads a CARMEN log, plain or gzipped: FLASER and RLASER, or ROBOTLASER1/2 where those are the
/// more frequent (a log may carry the same laser twice). RAWLASER1 where there are none of these:
/// its scans are at the odometry of the ODOM lines about them, interpolated by time. RAWLASER2,
/// which looks back, where there is no RAWLASER1 either: how far apart the two lasers are no line
/// tells, and a map would have each wall twice. Nor does one tell where LASER3, LASER4 and
/// RAWLASER3 to 5 look: these are counted in a warning.
///
/// No return: see Saturation; for ROBOTLASER also 0.999 of the line's own maximum range. Such beams
/// say nothing about free space (glass and black cloth give them too). PARAM lines are not trusted.
/// Logs that GMapping rewrote carry corrected poses in place of the odometry; where ODOM lines lead
/// from scan to scan, the raw odometry is put together again from them.
/// @throws std::runtime_error where the file cannot be read or holds no laser scan.
std::unique_ptr<LogReader> openCarmenLog(const std::string& path);

}  // namespace cca
