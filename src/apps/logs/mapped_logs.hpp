// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/runs/background_work.hpp"
#include "apps/runs/interruption.hpp"
#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/io/scan_raster.hpp"
#include "cca_mrpt/session/mapping_session.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "io/files/memory_file.hpp"
#include "io/poses/local_frame.hpp"
#include "io/poses/pose_source.hpp"
#include "io/replay/replay.hpp"
#include "live/live_page.hpp"

namespace cca::apps {

/// What `map` is asked for.
struct LogsToMap {
  std::vector<std::string> paths;
  PoseSource pose;
  std::optional<StoredMemory> memory;  ///< of earlier drives
  std::string resumed;                 ///< the folder that it is from
  std::optional<double> sweep;         ///< s, see MappingSession::Settings
};

/// Takes logs through a mapping session, and keeps what goes into the map's folder. All of it
/// stands in one frame.
class MappedLogs : public MapRecorder {
 public:
  /// @param first  of the logs, opened; it says where the frame lies.
  MappedLogs(const LogsToMap& logs, const LocalLog& first, const Parameters& parameters);

  /// Shows what becomes of the logs from now on, and waits while a viewer wants it.
  void obey(LivePage& page) { page_ = &page; }

  /// Goes through a log. @throws std::runtime_error naming the log.
  void take(const std::string& path, LocalLog& log, const Interruption& interruption);
  /// Works out what all logs together tell.
  void finish();

  MapProducts products() const;
  const std::string& warnings() const { return warnings_; }
  /// Why this is not the map that was asked for; empty where it is.
  std::string shortcoming() const;
  std::size_t scans() const { return session_->trajectory().size(); }
  bool isInterrupted() const { return interrupted_; }

 private:
  /// What a log tells of a scan beside what is mapped.
  struct Telling {
    double time;  ///< s
    std::optional<Pose2> reference;
  };
  void restart() override;
  void record(const MappedScan& mapped, const LineMap& map) override;
  void show(const ReplayMoment& moment, const Scan& scan, const LineMap& map);
  void heedCommands(const Interruption& interruption);
  const Slam* slam() const { return slam_ ? &slam_->slam() : nullptr; }
  static void addVisits(nlohmann::ordered_json& summary, const LoopReview& review);
  void addPoseError(nlohmann::ordered_json& summary) const;

  LogsToMap logs_;
  Parameters parameters_;
  SlamLocaliser* slam_ = nullptr;  ///< the session's, where the poses are line SLAM's
  std::unique_ptr<MappingSession> session_;
  Eigen::Vector2d start_;                 ///< m: about where the logs begin
  Eigen::Vector2d origin_;                ///< m, of the frame that all this stands in
  std::size_t beams_ = 0, unguided_ = 0;  ///< of all scans; scans without odometry
  std::string warnings_;                  ///< what could not be read, or was missed
  bool interrupted_ = false;
  LivePage* page_ = nullptr;
  // What background_ alone changes until finish().
  std::vector<Telling> told_;  ///< of each scan
  ScanRaster grid_;
  Replay replay_;
  std::optional<Pose2> last_moment_;
  double distance_ = 0.0;  ///< m, up to the last moment
  /// Maps while the log is read on; until finish().
  std::unique_ptr<BackgroundWork> background_;
};

}  // namespace cca::apps
