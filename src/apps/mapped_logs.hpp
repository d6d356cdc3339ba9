// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "background_work.hpp"
#include "cca_mrpt/io/local_frame.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/memory_file.hpp"
#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/io/replay.hpp"
#include "cca_mrpt/io/scan_grid.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "interruption.hpp"

namespace cca::apps {

/// What `map` is asked for.
struct LogsToMap {
  std::vector<std::string> paths;
  std::string pose;                    ///< see poseKind()
  std::optional<StoredMemory> memory;  ///< of earlier drives
  std::string resumed;                 ///< the folder that it is from
};

/// What is kept of logs while they are mapped. All of it stands in one frame.
class MappedLogs {
 public:
  /// @param first  of the logs, opened; it says where the frame lies.
  MappedLogs(const LogsToMap& logs, const LocalLog& first, const CcaParameters& mapping);

  /// Goes through a log. @throws std::runtime_error naming the log.
  void take(const std::string& path, LocalLog& log, const IcpParameters& icp,
            const Interruption& interruption);
  /// Works out what all logs together tell.
  void finish();

  /// @param parameters  what is written to summary.json of them.
  MapProducts products(const Parameters& parameters) const;
  const std::string& warnings() const { return warnings_; }
  std::size_t scans() const { return trajectory_.size(); }
  bool isInterrupted() const { return interrupted_; }

 private:
  void addMoment(const LogRecord& record, const Pose2& T_map_robot);
  /// @param record  its scan at the place where it belongs in the map.
  void insert(const LogRecord& record, const Pose2& T_map_robot, bool is_placed = true);
  void draw(const Scan& scan);
  void insertMemory(const std::vector<Pose2>& T_map_robot);
  std::string locateScanByScan(LocalLog& log, const IcpParameters& icp,
                               const Interruption& interruption);
  void locateBySlam(LocalLog& log, const Interruption& interruption);
  std::string tellOfSlam(const std::vector<bool>& is_placed) const;
  std::string straysTold() const;
  void warn(const std::string& warning);

  LogsToMap logs_;
  LineMap map_;
  ScanAgreement agreement_;
  ScanGrid grid_;
  Eigen::Vector2d origin_;  ///< m, of the frame that all this stands in
  std::optional<Slam> slam_;
  std::vector<LogRecord> records_;  ///< that wait for SLAM's last word
  std::vector<Pose2> trajectory_;
  std::vector<double> times_;              ///< s, of each scan
  std::vector<Pose2> judged_, reference_;  ///< poses for which a reference is known, and these
  Replay replay_;
  std::optional<Pose2> last_moment_;
  double distance_ = 0.0;  ///< m, up to the last moment
  std::size_t beams_ = 0;
  std::size_t unplaced_ = 0;  ///< scans that nobody knows the place of, and that are in no map
  std::string warnings_;      ///< what could not be read, or was missed
  bool interrupted_ = false;
  /// Draws lines and the replay while the log is read on; until finish().
  std::unique_ptr<BackgroundWork> drawing_;
};

}  // namespace cca::apps
