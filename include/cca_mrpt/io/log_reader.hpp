// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cca_mrpt/sensing/scan.hpp"
#include "cca_mrpt/sensing/sweep_motion.hpp"

namespace cca {

/// One laser scan of a log with all the poses that the log knows for it (of the robot's base where
/// the log tells the sensor's place on it, else of the sensor).
struct LogRecord {
  Scan scan;              ///< T_map_sensor from `corrected`, else `odometry`, else identity
  double time = 0.0;      ///< s; 0 where the log does not tell
  bool has_time = true;   ///< whether the log tells the time of this scan
  bool is_judged = true;  ///< by MissingReturns; readers do so
  Pose2 T_robot_sensor;   ///< identity where the log does not tell
  std::optional<Pose2> corrected;   ///< T_map_robot as a SLAM system had stored it
  std::optional<Pose2> odometry;    ///< T_odom_robot
  std::optional<Pose2> truth;       ///< T_map_robot of a simulation
  SweepMotion motion;               ///< as far as the log tells
  std::optional<SweptScan> undone;  ///< see openUndistortedLog()
};

/// A log, scan by scan. The scans' number counts from 0 in the order that next() gives.
class LogReader {
 public:
  virtual ~LogReader() = default;
  /// The next scan, or nothing at the end.
  virtual std::optional<LogRecord> next() = 0;
  /// What could not be read, for people; empty where all was well.
  virtual std::string warnings() const = 0;
  /// How much of the log has been read, in [0, 1].
  virtual double progress() const = 0;
};

/// How a laser hangs on its robot.
struct SensorMount {
  Pose2 T_robot_sensor;
  bool upside_down = false;
};

/// What a log may not tell, or tell more than once.
struct LogHints {
  std::string topic = {};       ///< of the laser; empty: the one with most scans
  std::string base_frame = {};  ///< of the robot; empty: as the log's own frames tell it
  std::optional<SensorMount> mount = {};
  /// s, of each laser, as Scan::sweep_duration; nothing: the scans tell it.
  std::optional<double> sweep = {};

  /// Whether there are none of those that only a bag can heed.
  bool empty() const { return topic.empty() && base_frame.empty() && !mount; }
};

/// Opens a log by its content: MRPT .rawlog, .simplemap, CARMEN .log, CSV of ranges, CoreSLAM .dat,
/// csm .json, ROS .bag (in builds with ROS), each also gzipped. A file of true poses beside it
/// (LOG.GT.txt, STEM_GT.txt) is read with it. Scans that are no evidence (see ScanFaults) are left
/// out, with a warning. The others are as the laser took them: see MappingSession and
/// openUndistortedLog().
/// @param hints  all but the sweep for bags only.
/// @throws std::runtime_error naming the file and the reason; also where it holds no scan, and for
///         hints that it cannot heed.
std::unique_ptr<LogReader> openLog(const std::string& path, const LogHints& hints = {});

/// A log whose scans are brought to one instant each, see MotionCompensation, by its odometry, else
/// by its corrected poses: for who has no MappingSession. A first pass finds out how each laser
/// sweeps.
/// @throws std::runtime_error  as openLog().
std::unique_ptr<LogReader> openUndistortedLog(const std::string& path, const LogHints& hints = {});

/// A kind of log that openLog() knows besides its own.
struct LogKind {
  std::string name;  ///< for people, as in messages
  /// Whether a file that begins with these bytes (unzipped) is one.
  std::function<bool(const std::string& head)> recognizes;
  /// @param file  unzipped; the reader is the last thing of its process that reads it.
  /// @throws std::runtime_error with the reason.
  std::function<std::unique_ptr<LogReader>(const std::string& file, const LogHints& hints)> open;
};

/// Makes openLog() know one more kind of log. Not for use while logs are being opened.
void addLogKind(LogKind kind);

}  // namespace cca
