// SPDX-License-Identifier: BSD-3-Clause
#include "localized_log.hpp"

#include <algorithm>

#include "io/logs/measurements.hpp"

namespace cca::apps {
namespace {

/// Of where a log begins, as people tell it: half a metre and 15 degrees are two sigmas.
constexpr double kStartSigma = 0.25, kStartTurnSigma = 0.13;

}  // namespace

LocalizedLog::LocalizedLog(const std::vector<PlanLine>& plan, const std::optional<Pose2>& start)
    : localiser_(plan) {
  if (!start) return;
  const Eigen::Vector3d sigmas(kStartSigma, kStartSigma, kStartTurnSigma);
  localiser_.place(*start, sigmas.cwiseAbs2().asDiagonal());
}

void LocalizedLog::take(LogReader& log, const std::function<bool()>& goes_on) {
  while (!interrupted_) {
    const std::optional<LogRecord> record = log.next();
    if (!record) break;
    const Estimate estimate = localiser_.localise(measurementOf(*record, PoseSource::kSlam));
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
  if (!record.truth) return;
  const double off = (estimate.T_map_robot.position() - record.truth->position()).norm();
  error_sq_.add(off * off);
  worst_error_ = std::max(worst_error_, off);
}

std::string LocalizedLog::whyNot() const {
  const std::vector<Hypothesis>& places = localiser_.global().hypotheses();
  if (places.empty()) return "nothing of it looks like what was seen";
  if (places.size() == 1) return "the one place that looks like it does not look like it enough";
  return std::to_string(places.size()) + " places look like what was seen";
}

void LocalizedLog::describe(const PlanFile& plan, const std::string& path,
                            nlohmann::ordered_json& summary) const {
  double length = 0.0;
  for (const auto& [a, b] : plan.lines) length += (b - a).norm();
  summary["plan"] = {
      {"file", path}, {"kind", plan.kind}, {"lines", plan.lines.size()}, {"length_m", length}};
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
  if (error_sq_.count > 0.0) {
    summary["pose_error"] = {{"rms_m", std::sqrt(error_sq_.mean())}, {"max_m", worst_error_}};
  }
  if (!warnings_.empty()) summary["warnings"] = warnings_;
}

}  // namespace cca::apps
