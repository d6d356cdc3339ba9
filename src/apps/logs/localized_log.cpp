// SPDX-License-Identifier: BSD-3-Clause
#include "localized_log.hpp"
#include "known_map/global_localisation.hpp"
#include "known_map/plan_sight.hpp"

#include <algorithm>
#include <chrono>

#include "io/files/text.hpp"
#include "io/logs/measurements.hpp"
#include "told_start.hpp"

namespace cca::apps {

LocalizedLog::LocalizedLog(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas,
                           const std::optional<Pose2>& start)
    : localiser_(plan, sigmas) {
  if (start) placeAbout(*start, localiser_);
}

void LocalizedLog::take(LogReader& log, const std::function<bool()>& goes_on) {
  while (!interrupted_) {
    const std::optional<LogRecord> record = log.next();
    if (!record) break;
    const auto begin = std::chrono::steady_clock::now();
    const Estimate estimate = localiser_.localise(measurementOf(*record, PoseSource::kSlam));
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    seconds_ += passed.count();
    worst_seconds_ = std::max(worst_seconds_, passed.count());
    note(estimate, *record);
    ++scans_;
    interrupted_ = !goes_on();
  }
  warnings_ = log.warnings();
}

void LocalizedLog::note(const Estimate& estimate, const LogRecord& record) {
  if (!estimate.is_known) return;
  if (!first_) first_ = scans_;
  poses_.push_back(
      {record.has_time ? record.time : static_cast<double>(scans_), estimate.T_map_robot});
  const SightShares& seen = localiser_.seen();
  if (seen.count() > 0.0) explained_.add(seen.explained / seen.count());
  agreement_.add(estimate.agreement);
  residual_sq_.add(localiser_.residual() * localiser_.residual());
  const Eigen::Matrix3d& P = estimate.covariance;
  covariances_ += formatted("%.6f,%.4e,%.4e,%.4e,%.4e,%.4e,%.4e\n", poses_.back().time, P(0, 0),
                            P(0, 1), P(0, 2), P(1, 1), P(1, 2), P(2, 2));
  if (const auto reference = referencePose(record)) errors_.add(estimate, *reference);
}

std::string LocalizedLog::covariancesCsv() const {
  return "stamp,xx,xy,xt,yy,yt,tt\n" + covariances_;
}

std::string LocalizedLog::whyNot() const {
  const std::vector<Hypothesis>& places = localiser_.global().hypotheses();
  if (places.empty()) return "nothing of it looks like what was seen";
  if (places.size() == 1) return "the one place that looks like it does not look like it enough";
  return std::to_string(places.size()) + " places look like what was seen";
}

std::string LocalizedLog::shortcoming(const PlanFile& plan, const std::string& path) const {
  if (explainedShare() > 0.0) return {};  // poses about a start that was told are none found
  return "the robot was never localised in " + path + " (" + sizeInWords(plan.lines) +
         "): " + whyNot();
}

void LocalizedLog::describe(const PlanFile& plan, const std::string& path,
                            nlohmann::ordered_json& summary) const {
  double length = 0.0;
  for (const auto& [a, b] : plan.lines) length += (b - a).norm();
  const Eigen::Vector2d extent = boundsOf(plan.lines).sizes();
  summary["plan"] = {{"file", path},
                     {"kind", plan.kind},
                     {"lines", plan.lines.size()},
                     {"length_m", length},
                     {"extent_m", {extent.x(), extent.y()}}};
  if (!plan.not_understood.empty()) summary["plan"]["not_understood"] = plan.not_understood;
  summary["finished"] = !interrupted_;
  summary["scans"] = scans_;
  summary["localised"] = poses_.size();
  summary["localised_share"] =
      scans_ > 0 ? static_cast<double>(poses_.size()) / static_cast<double>(scans_) : 0.0;
  if (first_) {
    summary["first_localised_scan"] = *first_;
    summary["residual_rms_m"] = residual();
    summary["explained_share"] = explainedShare();
    summary["agreement"] = agreement_.mean();
    summary["plan_sigma_m"] = localiser_.planSigma();
  } else {
    summary["why_not_localised"] = whyNot();
  }
  summary["lost_times"] = timesLost();
  summary["localise_us"] = {
      {"mean", 1e6 * seconds_ / static_cast<double>(std::max<std::size_t>(1, scans_))},
      {"max", 1e6 * worst_seconds_}};
  if (errors_.count() > 0) summary["pose_error"] = errors_.json();
  if (!warnings_.empty()) summary["warnings"] = warnings_;
}

}  // namespace cca::apps
