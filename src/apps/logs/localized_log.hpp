// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/known_map/known_map.hpp"
#include "io/plans/plan_reader.hpp"
#include "io/poses/pose_files.hpp"
#include "pose_errors.hpp"

namespace cca::apps {

/// A log taken through the localisation in a plan, and what it showed.
class LocalizedLog {
 public:
  /// @param sigmas  see KnownMap.
  /// @param start   T_map_robot where the log begins, about; nothing: anywhere in the plan.
  LocalizedLog(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas,
               const std::optional<Pose2>& start);

  /// Goes through a log. @param goes_on  asked after each scan; where it says no, the rest is left.
  void take(LogReader& log, const std::function<bool()>& goes_on);

  /// Of the scans that were localised; stamped by the log's time, else by the scan's number.
  const std::vector<StampedPose>& poses() const { return poses_; }
  /// `stamp,xx,xy,xt,yy,yt,tt` (s, m^2, m rad, rad^2), map axes, a row for each of these.
  std::string covariancesCsv() const;
  std::size_t scans() const { return scans_; }
  int timesLost() const { return localiser_.timesLost(); }
  double explainedShare() const { return explained_.mean(); }
  double residual() const { return std::sqrt(residual_sq_.mean()); }  ///< m, rms
  bool isInterrupted() const { return interrupted_; }
  const std::string& warnings() const { return warnings_; }
  /// Where the robot was localised nowhere: why, for people; else empty. @param path  of the plan.
  std::string shortcoming(const PlanFile& plan, const std::string& path) const;
  /// What summary.json tells of it. @param path  of the plan.
  void describe(const PlanFile& plan, const std::string& path,
                nlohmann::ordered_json& summary) const;

 private:
  struct Mean {
    double sum = 0.0, count = 0.0;
    void add(double value) {
      sum += value;
      count += 1.0;
    }
    double mean() const { return count > 0.0 ? sum / count : 0.0; }
  };
  std::string whyNot() const;
  void note(const Estimate& estimate, const LogRecord& record);

  KnownMap localiser_;
  std::vector<StampedPose> poses_;
  std::size_t scans_ = 0;
  std::optional<std::size_t> first_;  ///< scan that was localised
  std::string covariances_;
  Mean explained_, agreement_, residual_sq_;
  PoseErrors errors_;  ///< where the log has the truth, or poses that somebody has corrected
  double seconds_ = 0.0, worst_seconds_ = 0.0;  ///< of localise(); of a scan
  bool interrupted_ = false;
  std::string warnings_;
};

}  // namespace cca::apps
