// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/session/mapping_session.hpp"

namespace cca {

/// An observation made at a known pose as a measurement that brings this pose along.
/// @param T_odom_robot  what the wheels say at that time.
Measurement measurementOf(const Observation& seen, const std::optional<Pose2>& T_odom_robot,
                          const SweepMotion& motion = {});

/// The one pipeline from scans to commands: a mapping session, and an explorer that sees each scan
/// where the session has localised it, and moves along where the past is corrected.
///
/// What the explorer does depends on the estimates alone, not on when the executor maps.
class ExplorationSession {
 public:
  struct Settings {
    CcaParameters mapping;
    RobotParameters robot;
    ExplorerParameters exploration;
    std::optional<double> sweep = {};  ///< see MappingSession::Settings
  };

  /// See MappingSession.
  ExplorationSession(std::unique_ptr<Localiser> localiser, const Settings& settings,
                     MapRecorder* recorder = nullptr, Executor executor = doNow);

  /// Localises and maps a scan.
  /// @param velocity  as measured.
  /// @return  what decide() is to be given, once who knows of more obstacles has added them.
  Observation sense(const Measurement& measurement, const Velocity& velocity);
  /// The next action. Cost: see Explorer::step().
  Action decide(const Observation& observation) { return explorer_.step(observation); }

  /// A scan of another laser: mapped, and seen by the explorer; see MappingSession::addSecondary().
  Estimate addSecondary(const Measurement& measurement, std::size_t sensor);

  /// See MappingSession::finish().
  void finish(const DoAll& do_all = doInTurn);

  /// Of the last scan.
  const Estimate& estimate() const { return estimate_; }
  MappingSession& mapping() { return mapping_; }
  const MappingSession& mapping() const { return mapping_; }
  Explorer& explorer() { return explorer_; }
  const Explorer& explorer() const { return explorer_; }

 private:
  MappingSession mapping_;
  Explorer explorer_;
  Estimate estimate_;
};

}  // namespace cca
