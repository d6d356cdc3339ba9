// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <map>
#include <string>

#include "cca_mrpt/mapping/scan_agreement.hpp"

namespace cca {

/// What /diagnostics tells once a second: rate of the scans in use, scans dropped by reason, time
/// spent on a scan, how far scans and map agree, and the node's state.
class NodeDiagnostics {
 public:
  using Dropped = std::map<std::string, long>;

  /// @param dropped  scans by reason; outlives this.
  NodeDiagnostics(ros::NodeHandle& node, ros::NodeHandle& private_node, const Dropped& dropped);

  /// @param agreement  of scans and map, with this scan.
  void scanUsed(double seconds_spent, const ScanAgreement& agreement);
  /// A figure to be told beside these.
  void note(const std::string& name, double value) { notes_[name] = value; }
  void setState(const std::string& state) { state_ = state; }

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  const Dropped& dropped_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
  ros::WallTime last_report_;
  long scans_ = 0, scans_reported_ = 0, dropped_reported_ = 0;
  double mean_ = 0.0, longest_ = 0.0;  // s a scan, since the last report
  ScanAgreement agreement_;
  std::map<std::string, double> notes_;
  std::string state_;
};

}  // namespace cca
