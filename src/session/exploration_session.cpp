// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/session/exploration_session.hpp"

#include <utility>

namespace cca {

ExplorationSession::ExplorationSession(std::unique_ptr<Localiser> localiser,
                                       const Settings& settings, MapRecorder* recorder,
                                       Executor executor)
    : mapping_(std::move(localiser), {settings.mapping}, recorder, std::move(executor)),
      explorer_(settings.robot, settings.exploration) {}

Observation ExplorationSession::sense(const Measurement& measurement, const Velocity& velocity) {
  const Estimate estimate = mapping_.add(measurement);
  if (estimate.was_corrected) explorer_.correct(mapping_.past());
  Observation observation;
  observation.scan = measurement.scan;
  observation.scan.T_map_sensor = estimate.T_map_sensor;
  observation.T_map_robot = estimate.T_map_robot;
  observation.velocity = velocity;
  observation.time = measurement.time;
  observation.is_localised = estimate.is_known;
  return observation;
}

Estimate ExplorationSession::addSecondary(const Measurement& measurement, std::size_t sensor) {
  const Estimate estimate = mapping_.addSecondary(measurement, sensor);
  if (!estimate.is_known) return estimate;
  Scan scan = measurement.scan;
  scan.T_map_sensor = estimate.T_map_sensor;
  explorer_.observe(scan, estimate.T_map_robot);
  return estimate;
}

void ExplorationSession::finish(const DoAll& do_all) {
  if (!mapping_.localiser().correctsPast()) return;
  mapping_.finish(do_all);
  explorer_.correct(mapping_.past());
}

}  // namespace cca
