// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/session/exploration_session.hpp"

#include <utility>

namespace cca {

Measurement measurementOf(const Observation& seen, const std::optional<Pose2>& T_odom_robot,
                          const SweepMotion& motion) {
  Measurement measurement;
  measurement.scan = seen.scan;
  measurement.T_robot_sensor = seen.T_map_robot.inverse() * seen.scan.T_map_sensor;
  measurement.T_odom_robot = T_odom_robot;
  measurement.T_map_robot = seen.T_map_robot;
  measurement.time = seen.time;
  measurement.motion = motion;
  return measurement;
}

ExplorationSession::ExplorationSession(std::unique_ptr<Localiser> localiser,
                                       const Settings& settings, MapRecorder* recorder,
                                       Executor executor)
    : mapping_(std::move(localiser), {settings.mapping, false, settings.sweep}, recorder,
               std::move(executor)),
      explorer_(settings.robot, settings.exploration) {}

Observation ExplorationSession::sense(const Measurement& measurement, const Velocity& velocity) {
  estimate_ = mapping_.add(measurement);
  if (estimate_.was_corrected) explorer_.correct(mapping_.past());
  Observation observation;
  observation.scan = mapping_.scan();
  observation.T_map_robot = estimate_.T_map_robot;
  observation.velocity = velocity;
  observation.time = measurement.time;
  observation.is_localised = estimate_.is_known;
  observation.range_sigma = mapping_.analysed().noise.range_sigma;
  return observation;
}

Estimate ExplorationSession::addSecondary(const Measurement& measurement, std::size_t sensor) {
  const Estimate estimate = mapping_.addSecondary(measurement, sensor);
  if (estimate.was_corrected) explorer_.correct(mapping_.past());
  if (!estimate.is_known) return estimate;
  explorer_.observe(mapping_.scan(), estimate.T_map_robot, mapping_.analysed().noise.range_sigma);
  return estimate;
}

void ExplorationSession::finish(const DoAll& do_all) {
  mapping_.finish(do_all);
  if (mapping_.localiser().correctsPast()) explorer_.correct(mapping_.past());
}

}  // namespace cca
