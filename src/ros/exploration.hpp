// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <string>
#include <vector>

#include "cca_mrpt/io/parameters.hpp"
#include "exploration_publisher.hpp"
#include "map_record.hpp"
#include "map_saver.hpp"

namespace cca {

/// An Explorer with what a person does to it: the services `~start`, `~stop`, `~pause`, `~home`,
/// `~save`, and the topics of ExplorationPublisher. Where its observations come from, and where its
/// velocities go, is its owner's business.
class Exploration {
 public:
  struct Settings {
    std::string map_frame = "map";
    std::string title = "exploration";
    std::string out = "cca_map";  ///< folder for ~save, relative to where the node runs
    bool autostart = true;
    bool save_at_end = true;
  };

  Exploration(ros::NodeHandle& node, ros::NodeHandle& private_node, Settings settings,
              const Parameters& program);

  /// One step of the explorer. @return  zero unless it explores.
  /// observation.time may do what it likes: the explorer's own clock stands while it waits.
  Velocity step(Observation observation, const ros::Time& stamp);

  /// Neither paused, stopped nor finished.
  bool drives() const { return mode_ == Mode::kRunning && !finished_; }
  /// Also where it failed.
  bool finished() const { return finished_; }
  const ScanAgreement& agreement() const { return explorer_.agreement(); }
  /// Told as the status while the robot has to stand: why.
  void wait(const std::string& reason) { publisher_.showStatus("waiting: " + reason); }
  const std::string& state() const { return state_; }

  /// What Ctrl-C leaves behind: the map, where that is wanted and there is one.
  void end();

 private:
  enum class Mode { kStopped, kRunning, kPaused };

  bool onStart(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool onStop(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool onHome(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool onPause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  void setMode(Mode mode);
  void finish(const ros::Time& stamp);
  MapProducts products() const;
  void tell(const Action& action);
  bool isContradicted(double seconds);

  Settings settings_;
  Explorer explorer_;
  MapRecord record_;
  ExplorationPublisher publisher_;
  MapSaver saver_;
  Mode mode_;
  bool finished_ = false, failed_ = false;
  double own_time_ = 0.0, last_time_ = 0.0;  // s
  double contradicted_for_ = 0.0;            // s, that scans and map have been at odds
  std::string state_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace cca
