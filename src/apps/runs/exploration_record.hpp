// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/io/scan_raster.hpp"
#include "cca_mrpt/session/exploration_session.hpp"
#include "cca_mrpt/simulation/coverage.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "io/logs/rawlog_writer.hpp"
#include "io/replay/replay.hpp"
#include "navigation/planning/global_planner.hpp"

namespace cca::apps {

/// What is kept of a simulated exploration for the files of its folder.
class ExplorationRecord : public MapRecorder {
 public:
  /// How a run ended.
  struct End {
    bool finished = false;
    std::string reason;
    double wall_s = 0.0;
    Plan plan;                   ///< the last one
    bool is_incomplete = false;  ///< see Explorer::isIncomplete()
  };

  /// Names of the files of its own, beside those of a map.
  static std::vector<const char*> files() { return {kLog, kTruth, kTrajectory, kCoverage}; }

  /// @param parameters  as they are told in summary.json.
  /// @param origin  m, map frame: where the simulation's frame lies; files are in the map frame.
  /// @throws std::runtime_error where the folder cannot be written to.
  ExplorationRecord(const Simulation& simulation, const Eigen::Vector2d& origin,
                    const Parameters& parameters, const std::string& folder);

  /// One cycle: what was, and what the robot made of it.
  struct Cycle {
    double time, distance;            ///< s, m, since the start
    Pose2 T_map_robot, T_odom_robot;  ///< the truth, and what the wheels say
    Observation believed;             ///< what the explorer was given
    Scan scan;                        ///< as the laser gave it, sweep and all
    std::optional<Eigen::Vector2d> goal;
    double work_us;  ///< to localise and decide
  };
  void add(const Cycle& cycle);

  /// us; of the scan of the next cycle that is added.
  void addMappingTime(double work_us) { mapping_us_ += work_us; }

  void restart() override;
  void record(const MappedScan& mapped, const LineMap& map) override;

  /// Writes every file of the folder. @throws std::runtime_error naming the file.
  /// @param slam  where the poses are line SLAM's; else null.
  void write(const Simulation& simulation, const MappingSession& mapping, const SlamLocaliser* slam,
             const End& end);

  std::size_t scans() const { return truth_.size(); }
  const Eigen::Vector2d& origin() const { return origin_; }
  Coverage& coverage() { return coverage_; }
  Replay& replay() { return replay_; }
  /// What the map's files are made from, as it stands.
  MapProducts products(const Simulation& simulation, const MappingSession& mapping) const;

 private:
  static constexpr const char *kLog = "run.rawlog", *kTruth = "run_GT.txt",
                              *kTrajectory = "trajectory.csv", *kCoverage = "coverage.csv";
  struct Look {
    double time, distance;
  };
  void look(const Pose2& T_map_robot, double time, double distance);
  void writeTrajectory(const Simulation& simulation) const;
  void writeTruth() const;
  void writeCoverage();
  std::string packedReplay(const Simulation& simulation, const std::vector<MapLine>& lines);
  nlohmann::ordered_json summary(const Simulation& simulation, const MappingSession& mapping,
                                 const SlamLocaliser* slam, const End& end);

  std::string folder_;
  Parameters parameters_;
  Eigen::Vector2d origin_;
  RawlogWriter rawlog_;
  Eigen::Vector2d start_;  ///< m
  ScanRaster grid_;
  Coverage coverage_;
  Replay replay_;
  std::vector<Look> looks_;
  std::vector<TimedPose> truth_;  ///< of each scan
  std::vector<double> work_us_;
  double mapping_us_ = 0.0;
  std::optional<Pose2> last_look_;
  std::optional<Eigen::Vector2d> goal_;
  int goals_ = 0;
};

}  // namespace cca::apps
