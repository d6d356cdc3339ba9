// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/session/mapping_session.hpp"

#include <utility>

namespace cca {

void doNow(std::function<void()> work) { work(); }

MappingSession::MappingSession(std::unique_ptr<Localiser> localiser, const Settings& settings,
                               MapRecorder* recorder, Executor executor)
    : localiser_(std::move(localiser)),
      settings_(settings),
      recorder_(recorder),
      execute_(std::move(executor)),
      line_map_(emptyMap()) {}

LineMap MappingSession::emptyMap() const {
  return LineMap(settings_.mapping,
                 localiser_->correctsPast() ? LineMap::Poses::kOwn : LineMap::Poses::kGiven);
}

Estimate MappingSession::add(const Measurement& measurement) {
  last_ = localiser_->update(measurement, past_);
  trajectory_.push_back(last_.T_map_robot);
  times_.push_back(measurement.time);
  is_localised_.push_back(last_.is_known);
  if (last_.was_corrected) {
    takeCorrection();
    if (!settings_.maps_at_the_end) rebuild();
  }
  T_map_odom_.reset();
  if (measurement.T_odom_robot && last_.is_known) {
    T_map_odom_ = last_.T_map_robot * measurement.T_odom_robot->inverse();
  }
  Scan scan = measurement.scan;
  scan.T_map_sensor = last_.T_map_sensor;
  const bool corrects = localiser_->correctsPast();
  const bool is_kept = corrects && past_.add(scan, last_.T_map_robot, last_.is_known);
  if (last_.is_known && (is_kept || !corrects)) insert(std::move(scan), last_.T_map_robot, 0);
  return last_;
}

Estimate MappingSession::addSecondary(const Measurement& measurement, std::size_t sensor) {
  Estimate estimate;
  Scan scan = measurement.scan;
  estimate.is_known = !trajectory_.empty() && (measurement.T_map_robot || T_map_odom_);
  if (!estimate.is_known) return estimate;
  if (measurement.T_map_robot) {
    estimate.T_map_robot = *measurement.T_map_robot;
    estimate.T_map_sensor = scan.T_map_sensor;
  } else {
    estimate.is_known = measurement.T_odom_robot.has_value();
    if (!estimate.is_known) return estimate;
    estimate.T_map_robot = *T_map_odom_ * *measurement.T_odom_robot;
    estimate.T_map_sensor = estimate.T_map_robot * measurement.T_robot_sensor;
  }
  scan.T_map_sensor = estimate.T_map_sensor;
  const bool corrects = localiser_->correctsPast();
  const bool is_kept =
      corrects && past_.addBeside(past_.size() - 1, scan, last_.T_map_robot, sensor);
  if (is_kept || !corrects) insert(std::move(scan), estimate.T_map_robot, sensor);
  return estimate;
}

void MappingSession::remember(Scan scan, const Pose2& T_map_robot, const Pose2& T_map_sensor) {
  scan.T_map_sensor = T_map_sensor;
  past_.add(scan, T_map_robot, false);
}

void MappingSession::finish(const DoAll& do_all) {
  localiser_->finish(do_all);
  mapAsItIs();
}

void MappingSession::mapAsItIs() {
  if (!localiser_->correctsPast()) {
    execute_([this] { line_map_.lookBack(); });
    return;
  }
  takeCorrection();
  rebuild();
}

void MappingSession::takeCorrection() {
  const std::vector<Pose2> poses = localiser_->trajectory();
  const std::vector<bool> localised = localiser_->isLocalised();
  past_.correct(poses, localised);
  const auto own = static_cast<std::ptrdiff_t>(localiser_->remembered());
  trajectory_.assign(poses.begin() + own, poses.end());
  is_localised_.assign(localised.begin() + own, localised.end());
}

void MappingSession::rebuild() {
  execute_([this, kept = past_.kept(), earlier = localiser_->remembered()] {
    line_map_ = emptyMap();
    agreement_ = ScanAgreement();
    if (recorder_) recorder_->restart();
    for (const PastScans::Kept& one : kept) {
      const bool is_earlier = one.step < earlier;
      const std::size_t number = is_earlier ? one.step : one.step - earlier;
      insertNow({number, one.sensor, is_earlier, one.T_map_robot, one.scan});
    }
    line_map_.lookBack();
  });
}

void MappingSession::insert(Scan scan, const Pose2& T_map_robot, std::size_t sensor) {
  if (localiser_->correctsPast() && settings_.maps_at_the_end) return;
  execute_([this, number = trajectory_.size() - 1, sensor, T_map_robot, scan = std::move(scan)] {
    insertNow({number, sensor, false, T_map_robot, scan});
  });
}

void MappingSession::insertNow(const MappedScan& mapped) {
  agreement_.add(compareWithMap(mapped.scan, line_map_.walls()));
  line_map_.insert(mapped.scan);
  if (recorder_) recorder_->record(mapped, line_map_);
}

}  // namespace cca
