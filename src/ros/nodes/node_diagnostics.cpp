// SPDX-License-Identifier: BSD-3-Clause
#include "node_diagnostics.hpp"

#include <algorithm>

namespace cca {

NodeDiagnostics::NodeDiagnostics(ros::NodeHandle& node, ros::NodeHandle& private_node,
                                 const Dropped& dropped)
    : dropped_(dropped), updater_(node, private_node), last_report_(ros::WallTime::now()) {
  updater_.setHardwareID("none");
  updater_.add("scans", this, &NodeDiagnostics::report);
  // By the wall: a stopped clock is one of the things to be told.
  timer_ = node.createWallTimer(ros::WallDuration(1.0),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void NodeDiagnostics::scanUsed(double seconds_spent, const ScanAgreement& agreement) {
  agreement_ = agreement;
  ++scans_;
  const auto n = static_cast<double>(scans_ - scans_reported_);
  mean_ += (seconds_spent - mean_) / n;
  longest_ = std::max(longest_, seconds_spent);
}

void NodeDiagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Status = diagnostic_msgs::DiagnosticStatus;
  const ros::WallTime now = ros::WallTime::now();
  const double seconds = std::max(1e-3, (now - last_report_).toSec());
  const double rate = static_cast<double>(scans_ - scans_reported_) / seconds;
  long dropped = 0;
  for (const auto& [reason, count] : dropped_) {
    status.add("dropped: " + reason, count);
    dropped += count;
  }
  if (rate <= 0.0) {
    status.summary(Status::WARN, "no scans");
  } else if (agreement_.recent() < kPoorAgreement) {
    status.summary(Status::WARN, "scans contradict the map");
  } else if (dropped > dropped_reported_) {
    status.summary(Status::WARN, "scans are being dropped");
  } else {
    status.summary(Status::OK, "scans come in");
  }
  status.add("scan rate [Hz]", rate);
  status.add("scans used", scans_);
  status.add("scans dropped", dropped);
  status.add("time per scan, mean [ms]", 1e3 * mean_);
  status.add("time per scan, longest [ms]", 1e3 * longest_);
  status.add("agreement of scans and map", agreement_.recent());
  status.add("agreement since the start", agreement_.overall());
  for (const auto& [name, value] : notes_) status.add(name, value);
  if (!state_.empty()) status.add("state", state_);
  last_report_ = now;
  scans_reported_ = scans_, dropped_reported_ = dropped;
  mean_ = longest_ = 0.0;
}

}  // namespace cca
