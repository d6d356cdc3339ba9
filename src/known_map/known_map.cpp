// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/known_map/known_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "known_map/plan_fitting.hpp"
#include "known_map/wheel_track.hpp"
#include "slam/pose_covariance.hpp"
#include "slam/sweep_matching.hpp"

namespace cca {
namespace {

/// A scan from the same place tells of the same walls with the same errors of the plan: its news
/// grow with the way, up to so much (m), a turn of so much (rad).
constexpr double kNewsDistance = 0.25, kNewsTurn = 0.35;
/// Where the robot stands: the noise of its returns is new, the plan's errors there are not.
constexpr double kLeastNews = 0.02;

/// A scan errs as a whole by a part of what the wheels err by while it is swept: its ends are bent
/// apart, of which the mean is nought; and by this at least (m, rad).
constexpr double kOfSweepError = 0.15, kScanSigma = 0.003, kScanTurnSigma = 0.001;

/// By which the sweep of the next one is undone: one and five of them give the same to 2 %.
constexpr std::size_t kLastScans = 3;

/// Scans: one or two are of people, or a door, that pass by; one and a half seconds at 10 Hz of a
/// robot that stands, before which somebody may stop for a moment.
constexpr int kLostScansInDoubt = 3, kLostStandingInDoubt = 15;
constexpr double kLostWayInDoubt = 2.0 * kNewsDistance;      // m: two scans that are all news
constexpr double kVagueSigma = 1.0, kVagueTurnSigma = 0.35;  // m, rad: who knows no more is lost

/// m, of way that a place has been followed for, to be trusted: out of the room that it was found
/// in.
constexpr double kTrustedAfter = 3.0;
/// Of a scan in doubt: the robot may have slipped by a part of what is searched.
constexpr double kSlipSigma = 0.3, kSlipTurnSigma = 0.2;  // m, rad

double newsOf(const Pose2& step) {
  return std::clamp(step.position().norm() / kNewsDistance + std::abs(step.theta) / kNewsTurn,
                    kLeastNews, 1.0);
}

}  // namespace

/// All that is known of the place and of the robot in it.
class KnownMap::State {
 public:
  State(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas,
        const LocalisationEffort& effort);

  void place(const Pose2& T_map_robot, const Eigen::Matrix3d& covariance);
  Estimate update(const Measurement& measurement, const AnalysedScan& analysed);

  int timesLost() const { return times_lost_; }
  const SightShares& seen() const { return seen_; }
  double residual() const { return residual_; }
  const SightModel& sights() const { return fitting_.sights(); }
  double planSigma() const { return fitting_.planSigma(); }
  const PlanLines& plan() const { return fitting_.plan(); }
  const GlobalLocalisation& global() const { return fitting_.global(); }

 private:
  struct Told {
    Pose2 T_map_robot;
    Eigen::Matrix3d covariance;
  };
  /// Where the next scan was taken, by the motion since the last one alone.
  struct Prediction {
    Pose2 T_map_sensor;
    Eigen::Matrix3d covariance;
    PoseBelief belief() const { return {T_map_sensor, covariance.inverse()}; }
  };
  /// Scans in doubt, one after the other.
  struct Doubts {
    int scans = 0;
    double way = 0.0;  ///< m, turns too
  };
  struct Kept {
    ScanSurface surface;
    Pose2 T_map_sensor;
  };

  Eigen::Matrix3d scanCovariance(const MotionBelief& motion) const;
  Prediction predict(const MotionBelief& motion) const;
  void straighten(const SweptScan& undone, const MotionBelief& motion, bool by_wheels,
                  ScanSurface& surface);
  void keep(ScanSurface surface);
  void track(const TakenScan& scan, const std::optional<Pose2>& wheel_step,
             const MotionBelief& motion);
  void search(const TakenScan& scan, const MotionBelief& motion);
  void takePlace(const TakenScan& scan, const Pose2& T_robot_sensor);
  /// The robot is where it was found, and is followed from there on.
  void follow(const PlanFit& found);
  void learnWay();
  void countDoubt(bool is_doubtful, const Pose2& step);
  Estimate estimate(const Pose2& T_robot_sensor) const;

  PlanFitting fitting_;
  LocalisationEffort effort_;
  MotionPrior motion_;
  WheelTrack wheels_;
  std::deque<Kept> last_;  ///< of a laser that sweeps: scans that were localised
  std::optional<Told> told_;
  std::optional<Pose2> last_odom_sensor_;
  Pose2 T_map_sensor_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  LineSigma map_sigma_;        ///< of the last match, see PlanMatch
  double followed_way_ = 0.0;  ///< m, since it was placed or found
  bool is_localised_ = false, is_fresh_ = true;
  int times_lost_ = 0;
  Doubts doubts_;
  SightShares seen_;
  double residual_ = 0.0;
};

KnownMap::State::State(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas,
                       const LocalisationEffort& effort)
    : fitting_(plan, sigmas), effort_(effort) {}

void KnownMap::State::place(const Pose2& T_map_robot, const Eigen::Matrix3d& covariance) {
  told_ = Told{T_map_robot, covariance};
}

Estimate KnownMap::State::update(const Measurement& measurement, const AnalysedScan& analysed) {
  ScanSurface surface = scanSurface(analysed);
  std::optional<Pose2> odom_sensor, wheel_step;
  if (measurement.T_odom_robot && isFinite(*measurement.T_odom_robot)) {
    odom_sensor = *measurement.T_odom_robot * measurement.T_robot_sensor;
  }
  if (odom_sensor && last_odom_sensor_) wheel_step = last_odom_sensor_->inverse() * *odom_sensor;
  last_odom_sensor_ = odom_sensor;
  const MotionBelief motion = motion_.predict(wheel_step);
  wheels_.add(motion.T_before_after);
  const bool is_followed = is_localised_ && !told_;
  if (measurement.undone && is_followed) {
    straighten(*measurement.undone, motion, wheel_step.has_value(), surface);
  }
  const TakenScan scan{surface, sightRays(surface), scanCovariance(motion)};
  if (told_) {
    takePlace(scan, measurement.T_robot_sensor);
  } else if (is_localised_) {
    track(scan, wheel_step, motion);
  } else {
    search(scan, motion);
  }
  if (!is_followed) last_.clear();
  if (measurement.undone && is_localised_ && doubts_.scans == 0) keep(std::move(surface));
  return estimate(measurement.T_robot_sensor);
}

Eigen::Matrix3d KnownMap::State::scanCovariance(const MotionBelief& motion) const {
  Eigen::Matrix3d covariance =
      kOfSweepError * rotatedCovariance(motion.covariance, T_map_sensor_.theta);
  covariance.diagonal() += Eigen::Vector3d(kScanSigma, kScanSigma, kScanTurnSigma).cwiseAbs2();
  return covariance;
}

KnownMap::State::Prediction KnownMap::State::predict(const MotionBelief& motion) const {
  const Pose2 T_map_sensor = T_map_sensor_ * motion.T_before_after;
  return {T_map_sensor,
          leveredCovariance(covariance_, T_map_sensor.position() - T_map_sensor_.position()) +
              rotatedCovariance(motion.covariance, T_map_sensor_.theta)};
}

/// By what the last scans saw around, not by the plan: what is off in that looks like a motion.
void KnownMap::State::straighten(const SweptScan& undone, const MotionBelief& motion,
                                 bool by_wheels, ScanSurface& surface) {
  std::vector<PlacedSurface> references;
  for (const Kept& kept : last_) references.push_back({&kept.surface, kept.T_map_sensor});
  const PoseBelief prior = predict(motion).belief();
  const auto fit = matchSweep(surface, undone, prior.mean, prior,
                              sweepBelief(undone.motion, motion_, by_wheels), references);
  if (!fit) return;
  if (by_wheels) motion_.learnChange(fit->change_error, fit->expected_change_error);
  bendBy(fit->motion, undone, surface);
}

/// Where it shows what the last one kept does not.
void KnownMap::State::keep(ScanSurface surface) {
  if (!last_.empty() && newsOf(last_.back().T_map_sensor.inverse() * T_map_sensor_) < 1.0) return;
  last_.push_back({std::move(surface), T_map_sensor_});
  if (last_.size() > kLastScans) last_.pop_front();
}

void KnownMap::State::track(const TakenScan& scan, const std::optional<Pose2>& wheel_step,
                            const MotionBelief& motion) {
  const Pose2 before = T_map_sensor_;
  const Prediction predicted = predict(motion);
  const PoseBelief prior = predicted.belief();
  const double share = is_fresh_ ? 1.0 : newsOf(motion.T_before_after);
  const PlanFit fit = fitting_.fitAbout(scan, prior, share);
  const bool is_doubtful = fitting_.isDoubtful(fit);
  const bool is_matched = fit.match.paired > 0.0 && !fitting_.isRefuted(fit);
  T_map_sensor_ = is_matched ? fit.match.T_map_sensor : prior.mean;
  covariance_ = is_matched ? fit.match.posterior.inverse().eval() : predicted.covariance;
  seen_ = fit.seen;
  residual_ = fit.match.sigma;
  followed_way_ += motion.T_before_after.position().norm();
  if (is_matched) map_sigma_ = fit.match.map_sigma;
  if (is_matched && !is_doubtful) {
    if (followed_way_ > kTrustedAfter) wheels_.trust(T_map_sensor_);
    motion_.learn(wheel_step, motion, before.inverse() * T_map_sensor_,
                  rotatedCovariance(covariance_, -before.theta));
    fitting_.learn(fit, share);
    if (wheel_step) learnWay();
    is_fresh_ = false;
  }
  countDoubt(is_doubtful, motion.T_before_after);
}

/// Learns by how much the wheels count a way too short.
void KnownMap::State::learnWay() {
  const auto way = wheels_.judge(T_map_sensor_, covariance_.topLeftCorner<2, 2>());
  if (!way) return;
  motion_.learnWay(way->by_wheels / (1.0 + motion_.longer()), way->matched, way->variance);
}

void KnownMap::State::countDoubt(bool is_doubtful, const Pose2& step) {
  const PoseSpread spread = spreadOf(covariance_);
  if (!is_doubtful) {
    doubts_ = {};
  } else {
    ++doubts_.scans;
    doubts_.way += step.position().norm() + kNewsDistance / kNewsTurn * std::abs(step.theta);
  }
  const bool is_lost = (doubts_.scans >= kLostScansInDoubt && doubts_.way >= kLostWayInDoubt) ||
                       doubts_.scans >= kLostStandingInDoubt || spread.position > kVagueSigma ||
                       spread.turn > kVagueTurnSigma;
  if (!is_lost) return;
  is_localised_ = false;
  ++times_lost_;
  fitting_.global().begin();
}

void KnownMap::State::search(const TakenScan& scan, const MotionBelief& motion) {
  T_map_sensor_ = T_map_sensor_ * motion.T_before_after;
  GlobalLocalisation& global = fitting_.global();
  global.expect(wheels_.expectation());
  const auto found =
      global.add(scan.surface, wheels_.T_wheels_sensor(), fitting_.sights(), effort_);
  if (!found) return;
  const PlanFit fit = fitting_.fitAt(scan, found->mean, *found, PlanFitting::kLeastMatchReach, 1.0);
  if (fitting_.isDoubtful(fit)) return;
  T_map_sensor_ = fit.match.T_map_sensor;
  covariance_ = fit.match.posterior.inverse();
  follow(fit);
}

void KnownMap::State::follow(const PlanFit& found) {
  seen_ = found.seen;
  residual_ = found.match.sigma;
  map_sigma_ = found.match.map_sigma;
  wheels_.breakOff();
  followed_way_ = 0.0;
  is_localised_ = true;
  is_fresh_ = false;
  doubts_ = {};
}

void KnownMap::State::takePlace(const TakenScan& scan, const Pose2& T_robot_sensor) {
  PoseBelief prior;
  prior.mean = told_->T_map_robot * T_robot_sensor;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.diagonal() = told_->covariance.diagonal().cwiseMax(1e-6);
  prior.information = covariance.inverse();
  told_.reset();
  const PlanFit fit = fitting_.fitWithin(scan, prior);
  T_map_sensor_ = fit.match.paired > 0.0 ? fit.match.T_map_sensor : prior.mean;
  covariance_ = fit.match.paired > 0.0 ? fit.match.posterior.inverse().eval() : covariance;
  follow(fit);
}

Estimate KnownMap::State::estimate(const Pose2& T_robot_sensor) const {
  Estimate estimate;
  estimate.T_map_sensor = T_map_sensor_;
  estimate.T_map_robot = T_map_sensor_ * T_robot_sensor.inverse();
  estimate.is_known = is_localised_;
  estimate.agreement = is_localised_ ? seen_.agreement() : 0.0;
  if (!is_localised_) return estimate;
  Eigen::Matrix3d covariance = covariance_;
  const auto widen = [&](double shift, double turn) {
    covariance.diagonal() += Eigen::Vector3d(shift, shift, turn).cwiseAbs2();
  };
  widen(map_sigma_.offset, map_sigma_.angle);
  if (doubts_.scans > 0) widen(kSlipSigma, kSlipTurnSigma);
  estimate.covariance =
      leveredCovariance(covariance, estimate.T_map_robot.position() - T_map_sensor_.position());
  return estimate;
}

KnownMap::KnownMap(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas,
                   const LocalisationEffort& effort)
    : state_(std::make_unique<State>(plan, sigmas, effort)) {}
KnownMap::~KnownMap() = default;

void KnownMap::place(const Pose2& T_map_robot, const Eigen::Matrix3d& covariance) {
  state_->place(T_map_robot, covariance);
}

Estimate KnownMap::update(const Measurement& measurement, const AnalysedScan& analysed,
                          const PastScans& /*past*/) {
  return state_->update(measurement, analysed);
}

Estimate KnownMap::localise(const Measurement& measurement) {
  return state_->update(measurement, analyse(measurement.scan));
}

int KnownMap::timesLost() const { return state_->timesLost(); }
const SightShares& KnownMap::seen() const { return state_->seen(); }
double KnownMap::residual() const { return state_->residual(); }
const SightModel& KnownMap::sights() const { return state_->sights(); }
double KnownMap::planSigma() const { return state_->planSigma(); }
const PlanLines& KnownMap::plan() const { return state_->plan(); }
const GlobalLocalisation& KnownMap::global() const { return state_->global(); }

}  // namespace cca
