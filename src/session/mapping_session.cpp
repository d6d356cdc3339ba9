// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/session/mapping_session.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "sensing/motion_compensation.hpp"
#include "slam/sweep_matching.hpp"

namespace cca {
namespace {

/// Headings err by so many deviations that a match tells: the map that it is matched to errs, too.
/// Explorations among straight walls, the robot's own poses: 1.2 to 3 times in the mean.
constexpr double kOfMatch = 2.0;

/// Puts a scan where it was taken. Its beams point no surer than the robot knows its heading.
void placeAsLocalised(const Pose2& T_map_sensor, const Estimate& localised, Scan& scan) {
  scan.T_map_sensor = T_map_sensor;
  scan.bearing_sigma =
      std::hypot(scan.bearing_sigma, kOfMatch * std::sqrt(localised.covariance(2, 2)));
}

}  // namespace

void doNow(std::function<void()> work) { work(); }

struct MappingSession::Compensations : std::map<std::size_t, MotionCompensation> {};

MappingSession::MappingSession(std::unique_ptr<Localiser> localiser, const Settings& settings,
                               MapRecorder* recorder, Executor executor)
    : localiser_(std::move(localiser)),
      settings_(settings),
      recorder_(recorder),
      execute_(std::move(executor)),
      compensations_(std::make_unique<Compensations>()),
      line_map_(emptyMap()) {}

MappingSession::~MappingSession() = default;
MappingSession::MappingSession(MappingSession&&) noexcept = default;
MappingSession& MappingSession::operator=(MappingSession&&) noexcept = default;

LineMap MappingSession::emptyMap() const {
  return LineMap(settings_.mapping,
                 localiser_->correctsPast() ? LineMap::Poses::kOwn : LineMap::Poses::kGiven);
}

void MappingSession::beginDrive() {
  compensations_->clear();
  lesson_.reset();
  lesson_is_due_ = true;
}

Estimate MappingSession::add(const Measurement& measurement) {
  return undistort(measurement, 0) ? repeat() : localise(measurement, 0);
}

Estimate MappingSession::addSecondary(const Measurement& measurement, std::size_t sensor) {
  return undistort(measurement, sensor) ? repeat() : localise(measurement, sensor);
}

double MappingSession::sweepDuration(std::size_t sensor) const {
  const auto found = compensations_->find(sensor);
  return found != compensations_->end() ? found->second.sweepDuration() : 0.0;
}

MotionCompensation& MappingSession::compensationOf(std::size_t sensor) {
  const auto found = compensations_->find(sensor);
  if (found != compensations_->end()) return found->second;
  const auto fresh = settings_.sweep ? MotionCompensation(*settings_.sweep) : MotionCompensation();
  return compensations_->emplace(sensor, fresh).first->second;
}

/// Where nobody tells, the robot goes on as from the scan before the last one to the last one.
SweepMotion MappingSession::motionOf(const Measurement& measurement, std::size_t sensor) const {
  SweepMotion motion = measurement.motion;
  const Pose2& T_robot_sensor = measurement.T_robot_sensor;
  if (motion.middle || !(measurement.time > 0.0)) return motion;
  if (measurement.T_odom_robot) {
    motion.middle = SensorReading{*measurement.T_odom_robot * T_robot_sensor, measurement.time};
    return motion;
  }
  const std::size_t n = state_.trajectory.size();
  if (sensor != 0 || n < 2 || !state_.is_localised[n - 1] || !state_.is_localised[n - 2]) return {};
  const SensorReading before{state_.trajectory[n - 2] * T_robot_sensor, state_.times[n - 2]};
  const SensorReading last{state_.trajectory[n - 1] * T_robot_sensor, state_.times[n - 1]};
  if (!(last.time > before.time)) return {};
  const Twist twist =
      twistBetween(before.T_odom_sensor, last.T_odom_sensor, last.time - before.time);
  const Pose2 T_map_sensor = last.T_odom_sensor * moveBy(twist, measurement.time - last.time);
  return {SensorReading{T_map_sensor, measurement.time}, last};
}

bool MappingSession::undistort(const Measurement& measurement, std::size_t sensor) {
  MotionCompensation& compensation = compensationOf(sensor);
  const int version = compensation.version(), lasers = compensation.lasers();
  analyseUndistorted(measurement, sensor);
  if (lesson_is_due_ || compensation.lasers() != lasers) beginLesson();
  if (!lesson_) return false;
  lesson_->taken.push_back({measurement, sensor});
  if (compensation.version() != version) return true;
  if (!isLearning() || lesson_->taken.size() >= kMostRepeated) lesson_.reset();
  return false;
}

/// Where poses are final, no map can be made anew but that of all scans.
void MappingSession::beginLesson() {
  lesson_is_due_ = false;
  lesson_.reset();
  if (!isLearning() || (!localiser_->correctsPast() && !state_.trajectory.empty())) return;
  if (auto snapshot = localiser_->snapshot()) {
    lesson_.emplace(Lesson{state_, std::move(snapshot), {}});
  }
}

bool MappingSession::isLearning() const {
  return std::any_of(compensations_->begin(), compensations_->end(),
                     [](const auto& laser) { return laser.second.isLearning(); });
}

Estimate MappingSession::repeat() {
  std::vector<Pose2> was = localiser_->trajectory();
  std::vector<bool> was_localised = localiser_->isLocalised();
  localiser_->restore(*lesson_->localiser);
  state_ = lesson_->before;
  for (auto& [sensor, compensation] : *compensations_) compensation.repeat();
  const bool corrects = localiser_->correctsPast();
  if (!corrects || !settings_.maps_at_the_end) rebuild();
  Estimate estimate;
  for (const Taken& taken : lesson_->taken) {
    analyseUndistorted(taken.measurement, taken.sensor);
    estimate = localise(taken.measurement, taken.sensor);
  }
  for (auto& [sensor, compensation] : *compensations_) compensation.learnOn();
  if (!corrects) return estimate;
  estimate.was_corrected = true;
  // Who moves along has to know from where.
  const std::vector<Pose2> poses = localiser_->trajectory();
  const std::vector<bool> localised = localiser_->isLocalised();
  for (std::size_t k = was.size(); k < poses.size(); ++k) {
    was.push_back(poses[k]);
    was_localised.push_back(localised[k]);
  }
  state_.past.correct(was, was_localised);
  state_.past.correct(poses, localised);
  return estimate;
}

/// By the odometry, and then by what the scan itself shows of the motion within.
void MappingSession::analyseUndistorted(const Measurement& measurement, std::size_t sensor) {
  MotionCompensation& compensation = compensationOf(sensor);
  analyseScan(compensation.undistort(measurement.scan, motionOf(measurement, sensor)));
  if (sensor != 0 || !compensation.undone()) return;
  const SweptScan& undone = *compensation.undone();
  const auto motion =
      localiser_->believesGivenPoses() && measurement.T_map_robot
          ? matchSweep(analysed_, undone, *measurement.T_map_robot * measurement.T_robot_sensor,
                       state_.past)
          : localiser_->sweepMotion(measurement, analysed_, undone);
  if (motion) analyseScan(compensation.undistortBy(*motion));
}

void MappingSession::analyseScan(Scan scan) {
  analysed_ = analyse(std::move(scan), settings_.mapping);
}

/// @pre  analysed_ is the scan of the measurement, undistorted.
Estimate MappingSession::localise(const Measurement& measurement, std::size_t sensor) {
  if (sensor != 0) return localiseSecondary(measurement, sensor);
  state_.last = localiser_->update(measurement, analysed_, state_.past);
  const Estimate& now = state_.last;
  state_.trajectory.push_back(now.T_map_robot);
  state_.times.push_back(measurement.time);
  state_.is_localised.push_back(now.is_known);
  if (now.was_corrected) {
    takeCorrection();
    if (!settings_.maps_at_the_end) rebuild();
  }
  state_.T_map_odom.reset();
  if (measurement.T_odom_robot && now.is_known) {
    state_.T_map_odom = now.T_map_robot * measurement.T_odom_robot->inverse();
  }
  if (!measurement.motion.middle && !measurement.T_odom_robot) {
    compensationOf(0).amend(now.T_map_sensor);
  }
  placeAsLocalised(now.T_map_sensor, now, analysed_.scan);
  const bool corrects = localiser_->correctsPast();
  const bool is_kept = state_.past.add(analysed_, now.T_map_robot, now.is_known);
  if (now.is_known && (is_kept || !corrects)) insert(analysed_, now.T_map_robot, 0);
  return now;
}

Estimate MappingSession::localiseSecondary(const Measurement& measurement, std::size_t sensor) {
  Estimate estimate;
  estimate.is_known = !state_.trajectory.empty() &&
                      (measurement.T_map_robot || (state_.T_map_odom && measurement.T_odom_robot));
  if (!estimate.is_known) return estimate;
  if (measurement.T_map_robot) {
    estimate.T_map_robot = *measurement.T_map_robot;
    estimate.T_map_sensor = measurement.scan.T_map_sensor;
  } else {
    estimate.T_map_robot = *state_.T_map_odom * *measurement.T_odom_robot;
    estimate.T_map_sensor = estimate.T_map_robot * measurement.T_robot_sensor;
  }
  placeAsLocalised(estimate.T_map_sensor, state_.last, analysed_.scan);
  const bool corrects = localiser_->correctsPast();
  PastScans& past = state_.past;
  const bool is_kept = past.addBeside(past.size() - 1, analysed_, state_.last.T_map_robot, sensor);
  if (is_kept || !corrects) insert(analysed_, estimate.T_map_robot, sensor);
  return estimate;
}

void MappingSession::remember(Scan scan, const Pose2& T_map_robot, const Pose2& T_map_sensor) {
  scan.T_map_sensor = T_map_sensor;
  state_.past.add(analyse(std::move(scan), settings_.mapping), T_map_robot, false);
}

void MappingSession::finish(const DoAll& do_all) {
  localiser_->finish(do_all);
  mapAsItIs();
}

void MappingSession::mapAsItIs() {
  if (!localiser_->correctsPast()) {
    execute_([this, kept = state_.past.kept()] { line_map_.lookBack(kept); });
    return;
  }
  takeCorrection();
  rebuild();
}

void MappingSession::takeCorrection() {
  const std::vector<Pose2> poses = localiser_->trajectory();
  const std::vector<bool> localised = localiser_->isLocalised();
  state_.past.correct(poses, localised);
  const auto own = static_cast<std::ptrdiff_t>(localiser_->remembered());
  state_.trajectory.assign(poses.begin() + own, poses.end());
  state_.is_localised.assign(localised.begin() + own, localised.end());
}

void MappingSession::rebuild() {
  execute_([this, kept = state_.past.kept(), earlier = localiser_->remembered()] {
    line_map_ = emptyMap();
    agreement_ = ScanAgreement();
    if (recorder_) recorder_->restart();
    for (const PastScans::Kept& one : kept) {
      const bool is_earlier = one.step < earlier;
      const std::size_t number = is_earlier ? one.step : one.step - earlier;
      insertNow({number, one.sensor, is_earlier, one.T_map_robot, one.seen.scan}, one.seen.lines);
    }
    line_map_.lookBack(kept);
  });
}

void MappingSession::insert(AnalysedScan analysed, const Pose2& T_map_robot, std::size_t sensor) {
  if (localiser_->correctsPast() && settings_.maps_at_the_end) return;
  execute_([this, number = state_.trajectory.size() - 1, sensor, T_map_robot,
            analysed = std::move(analysed)] {
    insertNow({number, sensor, false, T_map_robot, analysed.scan}, analysed.lines);
  });
}

void MappingSession::insertNow(const MappedScan& mapped, const std::vector<LineSegment>& lines) {
  agreement_.add(compareWithMap(mapped.scan, line_map_.walls()));
  line_map_.insert(mapped.scan, lines);
  if (recorder_) recorder_->record(mapped, line_map_);
}

}  // namespace cca
