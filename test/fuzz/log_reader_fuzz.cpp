// SPDX-License-Identifier: BSD-3-Clause
// Any bytes at all through openLog(): CARMEN text, MRPT objects, zipped or not. It may refuse them;
// what it gives must be usable: finite poses and angles.
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "cca_mrpt/io/log_reader.hpp"
#include "memory_file.hpp"

namespace {

bool isFinite(const cca::Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta);
}

void check(const cca::LogRecord& record) {
  const bool good = isFinite(record.scan.T_map_sensor) && isFinite(record.T_robot_sensor) &&
                    (!record.corrected || isFinite(*record.corrected)) &&
                    (!record.odometry || isFinite(*record.odometry)) &&
                    std::isfinite(record.scan.angle_min) &&
                    std::isfinite(record.scan.angle_increment) && std::isfinite(record.time);
  if (!good) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const cca::MemoryFile file(bytes, size);
  try {
    const auto log = cca::openLog(file.path());
    while (const auto record = log->next()) check(*record);
    log->warnings();
  } catch (const std::runtime_error&) {
  }
  return 0;
}
