// SPDX-License-Identifier: BSD-3-Clause
// Any bytes through openLog(), zipped or not. It may refuse them; what it gives must be usable:
// finite poses and angles. Left out are files that begin as MRPT's objects do: MRPT sizes vectors
// by what the file says, before it looks how long the file is, and any fuzzer stops at that.
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
  if (size > 4 && ((bytes[0] & 0x80) != 0 || (bytes[1] | bytes[2] | bytes[3]) == 0)) return 0;
  const cca::MemoryFile file(bytes, size);
  try {
    const auto log = cca::openLog(file.path());
    while (const auto record = log->next()) check(*record);
    log->warnings();
  } catch (const std::runtime_error&) {
  }
  return 0;
}
