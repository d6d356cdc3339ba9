// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "cca_mrpt/sensing/scan.hpp"
#include "io/files/gzip_archive.hpp"

namespace cca {

/// Writes a run as an MRPT rawlog of action-observation pairs, scan by scan as it happens:
/// RawLogViewer, rawlog-edit and icp-slam open it, and openLog() does.
class RawlogWriter {
 public:
  /// @param max_range  m, of the laser; beams without return read it.
  /// @throws std::runtime_error where the file cannot be written.
  RawlogWriter(const std::string& path, double max_range);

  /// One scan, and where the wheels say that the robot is.
  /// @param time  s, rising; 0 is the start of the run (written as 1970, as simulators do), also
  /// for
  ///              a sweep whose middle was before.
  /// @throws std::runtime_error naming the file, e.g. where the disk is full.
  void insert(const Scan& scan, const Pose2& T_robot_sensor, const Pose2& T_odom_robot,
              double time);

  /// Gives the file its name; without it, nothing remains.
  /// @throws std::runtime_error naming the file and the reason.
  void commit();

 private:
  GzipArchive file_;
  double max_range_;
  std::optional<Pose2> last_;
};

}  // namespace cca
