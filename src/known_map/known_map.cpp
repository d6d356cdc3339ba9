// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/known_map/known_map.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "known_map/global_localisation.hpp"
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

constexpr double kLeastMatchReach = 0.15;  // m: coarser than the finest reach of a match by a round

/// By which the sweep of the next one is undone: one and five of them give the same to 2 %.
constexpr std::size_t kLastScans = 3;

/// nats a beam, below which a scan is in doubt; and of what is usual here: where the plan explains
/// nearly all, a scan of which it explains half is from elsewhere.
constexpr double kDoubt = 0.1, kDoubtOfUsual = 0.5;
/// Shares, see isDoubtful(): in furnished rooms of ten plans the plan explains 58 to 67 % of a scan
/// and nothing goes through a wall; by chance it explains 25 %, and 30 % go through.
constexpr double kMostOfScan = 0.5, kUncontradicted = 0.95;
constexpr double kFewestRays = 8;     // that may put it there
constexpr double kBetterThere = 0.3;  // nats a beam, for a place found by a search
/// Scans: one or two are of people, or a door, that pass by; one and a half seconds at 10 Hz of a
/// robot that stands, before which somebody may stop for a moment.
constexpr int kLostScansInDoubt = 3, kLostStandingInDoubt = 15;
constexpr double kLostWayInDoubt = 2.0 * kNewsDistance;      // m: two scans that are all news
constexpr double kVagueSigma = 1.0, kVagueTurnSigma = 0.35;  // m, rad: who knows no more is lost

/// m: matches at both ends of such a way err by less than wheels do on it.
constexpr double kJudgedWay = 1.0;
/// m, of way that a place has been followed for, to be trusted: out of the room that it was found
/// in.
constexpr double kTrustedAfter = 3.0;
/// What wheels may err by while the robot is lost: at once [m, rad], of the way [m/m, rad/m], and
/// of turns [rad/rad].
constexpr double kWheelReach = 0.5, kWheelTurn = 0.25, kWheelPerWay = 0.15, kWheelTurnPerWay = 0.05,
                 kWheelTurnPerTurn = 0.05;
/// m, rad: of what errs by more, the place is sought anywhere. Nor is a place that somebody tells
/// sought farther around.
constexpr double kWidestReach = 3.0, kWidestTurn = 0.8;

/// Of a scan in doubt: the robot may have slipped by a part of what is searched.
constexpr double kSlipSigma = 0.3, kSlipTurnSigma = 0.2;  // m, rad

constexpr double kSearchHalfWidth = 1.0, kSearchHalfTurn = 0.8;  // m, rad: of a robot that slips

/// m: at first as of a plan that is drawn with care; at least what a pose errs by among true lines
/// (docs/localisation.md, .007 m); at most what a match's finest reach still pairs.
constexpr double kFirstPlanSigma = 0.02, kLeastPlanSigma = 0.007, kMostPlanSigma = 0.1;
constexpr double kLearnPlan = 0.03, kLearnSights = 0.05;  // of a scan that is all news
/// Rays through a piece, for it to be a door that stands open, and over those that it explains.
constexpr double kRaysThroughDoor = 6.0, kThroughOverExplained = 3.0, kRecordLimit = 50.0;

Eigen::Matrix3d inMapAxes(const Eigen::Matrix3d& covariance, double theta) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() << std::cos(theta), -std::sin(theta), std::sin(theta), std::cos(theta);
  return R * covariance * R.transpose();
}

/// That of a point which lies `arm` beside the one that the covariance is of.
Eigen::Matrix3d atArm(const Eigen::Matrix3d& covariance, const Eigen::Vector2d& arm) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J(0, 2) = -arm.y();
  J(1, 2) = arm.x();
  return J * covariance * J.transpose();
}

struct Spread {
  double position, turn;  // m, rad
};

Spread spreadOf(const Eigen::Matrix3d& covariance) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(covariance.topLeftCorner<2, 2>(), Eigen::EigenvaluesOnly);
  return {std::sqrt(std::max(0.0, axes.eigenvalues().maxCoeff())), std::sqrt(covariance(2, 2))};
}

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
  const SightModel& sights() const { return sights_; }
  double planSigma() const { return plan_sigma_; }
  const PlanLines& plan() const { return plan_; }
  const GlobalLocalisation& global() const { return global_; }

 private:
  struct Told {
    Pose2 T_map_robot;
    Eigen::Matrix3d covariance;
  };
  struct Fit {
    PlanMatch match;
    SightShares seen;
    std::vector<PieceSight> said;
    double evidence = 0.0;  ///< nats a beam
  };
  /// Where the next scan was taken, by the motion since the last one alone.
  struct Prediction {
    Pose2 T_map_sensor;
    Eigen::Matrix3d covariance;
    PoseBelief belief() const { return {T_map_sensor, covariance.inverse()}; }
  };
  /// What the beams said of a piece of the plan.
  struct PieceRecord {
    double explained = 0.0, through = 0.0;
  };
  Fit fitAt(const ScanSurface& surface, const Pose2& start, const PoseBelief& prior, double reach,
            double share) const;
  double doubt() const;
  bool isDoubtful(const Fit& fit) const;
  static double likelihood(const Fit& fit, const PoseBelief& prior);
  static double offSquared(const Fit& fit, const PoseBelief& prior);
  Prediction predict(const MotionBelief& motion) const;
  void straighten(const SweptScan& undone, const MotionBelief& motion, bool by_wheels,
                  ScanSurface& surface);
  void keep(ScanSurface surface);
  void track(const ScanSurface& surface, const std::optional<Pose2>& wheel_step,
             const MotionBelief& motion);
  Fit fitAbout(const ScanSurface& surface, const PoseBelief& prior, double share) const;
  void search(const ScanSurface& surface, const MotionBelief& motion);
  /// The robot is where it was found, and is followed from there on.
  void follow(const Fit& found);
  void takePlace(const ScanSurface& surface, const Pose2& T_robot_sensor);
  void learn(const Fit& fit, double share);
  void learnWay();
  void countDoubt(bool is_doubtful, const Pose2& step);
  void lose();
  void expectAlongWheels();
  Estimate estimate(const Pose2& T_robot_sensor) const;

  PlanLines plan_;
  LocalisationEffort effort_;
  GlobalLocalisation global_;
  MotionPrior motion_;
  SightModel sights_;
  double plan_sigma_;
  std::vector<PieceRecord> records_;
  std::vector<bool> is_open_;   ///< pieces that rays pass: doors
  std::vector<SightRay> rays_;  ///< of the scan at hand
  struct Kept {
    ScanSurface surface;
    Pose2 T_map_sensor;
  };
  std::deque<Kept> last_;  ///< of a laser that sweeps: scans that were localised
  std::optional<Told> told_;
  std::optional<Pose2> last_odom_sensor_;
  Pose2 T_map_sensor_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d scan_covariance_ = Eigen::Matrix3d::Identity();  ///< see PlanMatching
  LineSigma map_sigma_;                                            ///< see PlanMatch
  Pose2 T_wheels_sensor_;                        ///< since the beginning, whoever carried the robot
  double wheels_way_ = 0.0, wheels_turn_ = 0.0;  ///< m, rad, of these in all
  /// The last place that the robot has been followed to for a while, and when that was.
  struct Trusted {
    Pose2 T_map_wheels;
    double wheels_way, wheels_turn;
  };
  std::optional<Trusted> trusted_;
  /// Where the way that the wheels are judged by began.
  struct Anchor {
    Pose2 T_map_sensor, T_wheels_sensor;
    Eigen::Matrix2d covariance;  ///< m^2, map axes
  };
  std::optional<Anchor> anchor_;
  double followed_way_ = 0.0;  ///< m, since it was placed or found
  bool is_localised_ = false, is_fresh_ = true;
  int times_lost_ = 0;
  int doubtful_scans_ = 0;
  double doubtful_way_ = 0.0;
  SightShares seen_;
  double residual_ = 0.0;
};

KnownMap::State::State(const std::vector<PlanLine>& plan, const std::vector<LineSigma>& sigmas,
                       const LocalisationEffort& effort)
    : plan_(plan, sigmas),
      effort_(effort),
      global_(plan_),
      plan_sigma_(kFirstPlanSigma),
      records_(plan_.pieces().size()),
      is_open_(plan_.pieces().size(), false) {}

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
  T_wheels_sensor_ = T_wheels_sensor_ * motion.T_before_after;
  wheels_way_ += motion.T_before_after.position().norm();
  wheels_turn_ += std::abs(motion.T_before_after.theta);
  scan_covariance_ = kOfSweepError * inMapAxes(motion.covariance, T_map_sensor_.theta);
  scan_covariance_.diagonal() +=
      Eigen::Vector3d(kScanSigma, kScanSigma, kScanTurnSigma).cwiseAbs2();
  const bool is_followed = is_localised_ && !told_;
  if (measurement.undone && is_followed) {
    straighten(*measurement.undone, motion, wheel_step.has_value(), surface);
  }
  rays_ = sightRays(surface);
  if (told_) {
    takePlace(surface, measurement.T_robot_sensor);
  } else if (is_localised_) {
    track(surface, wheel_step, motion);
  } else {
    search(surface, motion);
  }
  if (!is_followed) last_.clear();
  if (measurement.undone && is_localised_ && doubtful_scans_ == 0) keep(std::move(surface));
  return estimate(measurement.T_robot_sensor);
}

KnownMap::State::Prediction KnownMap::State::predict(const MotionBelief& motion) const {
  const Pose2 T_map_sensor = T_map_sensor_ * motion.T_before_after;
  return {T_map_sensor, atArm(covariance_, T_map_sensor.position() - T_map_sensor_.position()) +
                            inMapAxes(motion.covariance, T_map_sensor_.theta)};
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

KnownMap::State::Fit KnownMap::State::fitAt(const ScanSurface& surface, const Pose2& start,
                                            const PoseBelief& prior, double reach,
                                            double share) const {
  PlanMatching how;
  how.first_reach = reach;
  how.plan_sigma = plan_sigma_;
  how.share = share;
  how.scan_covariance = scan_covariance_;
  Fit fit;
  fit.match = matchPlan(surface, start, prior, plan_, how);
  fit.seen = seePlan(rays_, fit.match.T_map_sensor, plan_, sightTolerance(surface.range_sigma),
                     is_open_, &fit.said);
  fit.evidence = sights_.evidence(fit.seen);
  return fit;
}

double KnownMap::State::doubt() const {
  return std::max(kDoubt, kDoubtOfUsual * sights_.evidence(sights_.usual()));
}

/// Where most of a scan is on the plan's lines and next to nothing goes through any, what else it
/// sees is furniture, however little of that is usual.
bool KnownMap::State::isDoubtful(const Fit& fit) const {
  const double count = fit.seen.count();
  if (fit.evidence >= doubt() || count < kFewestRays) return false;
  return fit.evidence < kDoubt || fit.seen.explained < kMostOfScan * count ||
         fit.seen.agreement() < kUncontradicted;
}

/// Squared deviations of a match from what was believed of the pose without it.
double KnownMap::State::offSquared(const Fit& fit, const PoseBelief& prior) {
  const Eigen::Vector3d off = difference(fit.match.T_map_sensor, prior.mean);
  return off.dot(prior.information * off);
}

/// nats, of a pose by its scan and by what was believed of it without.
double KnownMap::State::likelihood(const Fit& fit, const PoseBelief& prior) {
  return kOwnWord * fit.seen.count() * fit.evidence -
         0.5 * (kPriorFreedom + 3.0) * std::log1p(offSquared(fit, prior) / kPriorFreedom);
}

/// Downhill from the wheels' word, and from no farther off than a match is fine where that leads
/// beyond belief; where wheels may err by more than a match reaches, or where that does not fit,
/// from what fits best around.
KnownMap::State::Fit KnownMap::State::fitAbout(const ScanSurface& surface, const PoseBelief& prior,
                                               double share) const {
  const Spread spread = spreadOf(prior.information.inverse());
  const double span = kPriorSigmas * (spread.position + kTurnArm * spread.turn);
  const double reach = std::clamp(span, kLeastMatchReach, PlanLines::kMostReach);
  const auto bestWithin = [&](double half_width, double half_turn) {
    SearchWindow window;
    window.centre = prior.mean;
    window.half_width = std::min(half_width, kSearchHalfWidth);
    window.half_turn = half_turn;
    return global_.bestIn(window, surface);
  };
  Fit here = fitAt(surface, prior.mean, prior, reach, share);
  if (offSquared(here, prior) > kPriorSigmas * kPriorSigmas) {
    Fit near = fitAt(surface, prior.mean, prior, kLeastMatchReach, share);
    if (likelihood(near, prior) > likelihood(here, prior)) here = std::move(near);
  }
  if (span > PlanLines::kMostReach) {
    const double turn = std::min(kPriorSigmas * spread.turn, kSearchHalfTurn);
    if (const auto elsewhere = bestWithin(kPriorSigmas * spread.position, turn)) {
      Fit there = fitAt(surface, *elsewhere, prior, kFirstMatchReach, share);
      if (likelihood(there, prior) > likelihood(here, prior)) here = std::move(there);
    }
  }
  if (!isDoubtful(here)) return here;
  // A scan that speaks against the place: wheels that slip lose any turn, and little way.
  const auto elsewhere = bestWithin(kSearchHalfWidth, here.evidence < 0.0 ? M_PI : kSearchHalfTurn);
  if (!elsewhere) return here;
  PoseBelief vague = prior;
  vague.information *= 0.01;
  const Fit there = fitAt(surface, *elsewhere, vague, PlanLines::kMostReach, 1.0);
  return there.evidence > std::max(doubt(), here.evidence) + kBetterThere ? there : here;
}

void KnownMap::State::track(const ScanSurface& surface, const std::optional<Pose2>& wheel_step,
                            const MotionBelief& motion) {
  const Pose2 before = T_map_sensor_;
  const Prediction predicted = predict(motion);
  const PoseBelief prior = predicted.belief();
  const double share = is_fresh_ ? 1.0 : newsOf(motion.T_before_after);
  const Fit fit = fitAbout(surface, prior, share);
  const bool is_doubtful = isDoubtful(fit);
  // Half of what is usual may still be the best that is known of where the robot is.
  const bool is_refuted = is_doubtful && fit.evidence < kDoubt;
  const bool is_matched = fit.match.paired > 0.0 && !is_refuted;
  T_map_sensor_ = is_matched ? fit.match.T_map_sensor : prior.mean;
  covariance_ = is_matched ? fit.match.posterior.inverse().eval() : predicted.covariance;
  seen_ = fit.seen;
  residual_ = fit.match.sigma;
  followed_way_ += motion.T_before_after.position().norm();
  if (is_matched) map_sigma_ = fit.match.map_sigma;
  if (is_matched && !is_doubtful) {
    if (followed_way_ > kTrustedAfter) {
      trusted_ = {T_map_sensor_ * T_wheels_sensor_.inverse(), wheels_way_, wheels_turn_};
    }
    motion_.learn(wheel_step, motion, before.inverse() * T_map_sensor_,
                  inMapAxes(covariance_, -before.theta));
    learn(fit, share);
    if (wheel_step) learnWay();
    is_fresh_ = false;
  }
  countDoubt(is_doubtful, motion.T_before_after);
}

void KnownMap::State::learn(const Fit& fit, double share) {
  // What is usual is so in the plan: in a room that it has not, half of a scan may be in it.
  if (fit.evidence >= doubt()) sights_.learn(fit.seen, share * kLearnSights);
  if (fit.match.piece_variance >= 0.0) {
    const double variance = plan_sigma_ * plan_sigma_;
    const double learned = variance + share * kLearnPlan * (fit.match.piece_variance - variance);
    plan_sigma_ = std::clamp(std::sqrt(std::max(0.0, learned)), kLeastPlanSigma, kMostPlanSigma);
  }
  for (const PieceSight& said : fit.said) {
    const auto slot = static_cast<std::size_t>(said.slot);
    PieceRecord& record = records_[slot];
    double& count = said.is_through ? record.through : record.explained;
    count += share;
    if (count > kRecordLimit) {
      record.through *= 0.5;
      record.explained *= 0.5;
    }
    is_open_[slot] = record.through > kRaysThroughDoor &&
                     record.through > kThroughOverExplained * record.explained;
  }
}

/// Learns by how much the wheels count a way too short, from the matches at both its ends.
void KnownMap::State::learnWay() {
  const Eigen::Matrix2d covariance = covariance_.topLeftCorner<2, 2>();
  if (anchor_) {
    const Eigen::Vector2d by_wheels =
        (anchor_->T_wheels_sensor.inverse() * T_wheels_sensor_).position();
    const double way = by_wheels.norm();
    if (way < kJudgedWay) return;
    const Eigen::Vector2d matched = T_map_sensor_.position() - anchor_->T_map_sensor.position();
    const Eigen::Vector2d ahead = Pose2{0.0, 0.0, anchor_->T_map_sensor.theta} * (by_wheels / way);
    motion_.learnWay(way / (1.0 + motion_.longer()), ahead.dot(matched),
                     ahead.dot((anchor_->covariance + covariance) * ahead));
  }
  anchor_ = {T_map_sensor_, T_wheels_sensor_, covariance};
}

void KnownMap::State::countDoubt(bool is_doubtful, const Pose2& step) {
  const Spread spread = spreadOf(covariance_);
  if (!is_doubtful) {
    doubtful_scans_ = 0;
    doubtful_way_ = 0.0;
  } else {
    ++doubtful_scans_;
    doubtful_way_ += step.position().norm() + kNewsDistance / kNewsTurn * std::abs(step.theta);
  }
  const bool is_lost = (doubtful_scans_ >= kLostScansInDoubt && doubtful_way_ >= kLostWayInDoubt) ||
                       doubtful_scans_ >= kLostStandingInDoubt || spread.position > kVagueSigma ||
                       spread.turn > kVagueTurnSigma;
  if (is_lost) lose();
}

void KnownMap::State::lose() {
  is_localised_ = false;
  ++times_lost_;
  global_.begin();
}

void KnownMap::State::expectAlongWheels() {
  if (!trusted_) return;
  const double way = wheels_way_ - trusted_->wheels_way;
  const double turn = wheels_turn_ - trusted_->wheels_turn;
  Expectation expectation;
  expectation.T_map_wheels = trusted_->T_map_wheels;
  expectation.reach = std::min(kWheelReach + kWheelPerWay * way, kWidestReach);
  expectation.turn =
      std::min(kWheelTurn + kWheelTurnPerWay * way + kWheelTurnPerTurn * turn, kWidestTurn);
  global_.expect(expectation);
}

void KnownMap::State::search(const ScanSurface& surface, const MotionBelief& motion) {
  T_map_sensor_ = T_map_sensor_ * motion.T_before_after;
  expectAlongWheels();
  const auto found = global_.add(surface, T_wheels_sensor_, sights_, effort_);
  if (!found) return;
  const Fit fit = fitAt(surface, found->mean, *found, kLeastMatchReach, 1.0);
  if (isDoubtful(fit)) return;
  T_map_sensor_ = fit.match.T_map_sensor;
  covariance_ = fit.match.posterior.inverse();
  follow(fit);
}

void KnownMap::State::follow(const Fit& found) {
  seen_ = found.seen;
  residual_ = found.match.sigma;
  map_sigma_ = found.match.map_sigma;
  anchor_.reset();
  followed_way_ = 0.0;
  is_localised_ = true;
  is_fresh_ = false;
  doubtful_scans_ = 0;
  doubtful_way_ = 0.0;
}

void KnownMap::State::takePlace(const ScanSurface& surface, const Pose2& T_robot_sensor) {
  PoseBelief prior;
  prior.mean = told_->T_map_robot * T_robot_sensor;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.diagonal() = told_->covariance.diagonal().cwiseMax(1e-6);
  prior.information = covariance.inverse();
  told_.reset();
  const Spread spread = spreadOf(covariance);
  SearchWindow window;
  window.centre = prior.mean;
  window.half_width = std::min(kPriorSigmas * spread.position, kWidestReach);
  window.half_turn = std::min(kPriorSigmas * spread.turn, M_PI);
  Fit fit = fitAt(surface, prior.mean, prior, PlanLines::kMostReach, 1.0);
  if (const auto elsewhere = global_.bestIn(window, surface)) {
    const Fit there = fitAt(surface, *elsewhere, prior, PlanLines::kMostReach, 1.0);
    if (there.evidence > fit.evidence) fit = there;
  }
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
  if (doubtful_scans_ > 0) widen(kSlipSigma, kSlipTurnSigma);
  estimate.covariance =
      atArm(covariance, estimate.T_map_robot.position() - T_map_sensor_.position());
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
