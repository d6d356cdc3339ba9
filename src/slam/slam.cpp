// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/slam.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "slam/pose_covariance.hpp"
#include "slam/slam_state.hpp"

namespace cca {
namespace {

/// From a key frame to the next.
constexpr MatchScale kStepMatch{0.15, 0.04};

std::optional<Pose2> sensorOf(const std::optional<Pose2>& T_odom_robot,
                              const Pose2& T_robot_sensor) {
  if (!T_odom_robot || !isFinite(*T_odom_robot)) return std::nullopt;
  return *T_odom_robot * T_robot_sensor;
}

}  // namespace

SlamPose Slam::State::step(const AnalysedScan& analysed, const Pose2& T_robot_sensor,
                           const std::optional<Pose2>& T_odom_robot) {
  back_end_.restartCount();
  const Scan& scan = analysed.scan;
  ScanSurface surface = scanSurface(analysed);
  const std::optional<Pose2> T_odom_sensor = sensorOf(T_odom_robot, T_robot_sensor);
  const std::optional<Pose2> odometry_step = odometry_.stepTo(T_odom_sensor);
  odometry_.moveTo(T_odom_sensor);
  if (!map_.hasDriven(frames_.graph) || starts_anywhere_) {
    return beginPart(scan, T_robot_sensor, std::move(surface));
  }

  Tracked tracked = track(surface, odometry_step);
  odometry_.extend(tracked.motion, tracked.odometry_step.has_value());
  const Pose2& T_map_frame = frames_.graph.pose(frames_.size() - 1);
  if (const auto there =
          jump_.update(frames_, tracker_, monitor_, surface,
                       {T_map_frame, tracked.motion, tracked.prior, tracked.found})) {
    tracked.found = *there;
    jump();
  }
  const bool is_doubtful = takePose(tracked, surface.points.size());
  const Eigen::Matrix3d of_match = covariance_;  // a new frame is exactly where it is itself
  if (is_doubtful) {
    monitor_.add(tracked.motion.T_before_after, surface);
  } else {
    monitor_.clear();
  }

  const Pose2 T_last_now = frames_.graph.pose(frames_.size() - 1).inverse() * T_map_sensor_;
  if (monitor_.isLost() && !jump_.mayBeSlip()) {
    startPart(newFrame(scan, T_robot_sensor, std::move(surface)));
  } else if (!is_doubtful && isKeyFrameDue(T_last_now, surface)) {
    const GraphEdge edge = odometry_.edge(frames_.size() - 1);
    const bool is_measured = odometry_.isMeasured();
    addKeyFrame(newFrame(scan, T_robot_sensor, std::move(surface)), edge, is_measured);
  }
  const int frame = frames_.size() - 1;
  const Pose2 T_frame_sensor = frames_.graph.pose(frame).inverse() * T_map_sensor_;
  scans_.push_back({frame, T_frame_sensor, T_robot_sensor, is_doubtful});
  const double heading = T_map_sensor_.theta;
  advanceBackEnd();
  return poseNow(T_robot_sensor, tracked.found.agreement,
                 rotatedCovariance(of_match, T_map_sensor_.theta - heading));
}

std::optional<SweepHalves> Slam::State::sweepMotion(const AnalysedScan& analysed,
                                                    const SweptScan& sweep,
                                                    const Pose2& T_robot_sensor,
                                                    const std::optional<Pose2>& T_odom_robot) {
  if (!map_.hasDriven(frames_.graph) || starts_anywhere_) return std::nullopt;
  const auto odometry_step = odometry_.stepTo(sensorOf(T_odom_robot, T_robot_sensor));
  const PoseBelief prior = predict(motion_.predict(odometry_step));
  const SweepBelief belief = sweepBelief(sweep.motion, motion_, odometry_step.has_value());
  const auto fit = tracker_.sweepMotion(frames_, scanSurface(analysed), sweep, prior, belief);
  if (!fit) return std::nullopt;
  if (odometry_step) motion_.learnChange(fit->change_error, fit->expected_change_error);
  return fit->motion;
}

SlamPose Slam::State::beginPart(const Scan& scan, const Pose2& T_robot_sensor,
                                ScanSurface surface) {
  const bool is_first = !map_.hasDriven(frames_.graph);
  if (is_first) T_map_sensor_ = T_map_start_ * T_robot_sensor;
  const int frame = newFrame(scan, T_robot_sensor, std::move(surface));
  if (is_first) map_.begin(frame);
  startPart(frame);
  starts_anywhere_ = false;
  scans_.push_back({frame, {}, T_robot_sensor, false});
  return poseNow(T_robot_sensor, 1.0, covariance_);
}

PoseBelief Slam::State::predict(const MotionBelief& motion) const {
  PoseBelief belief;
  belief.mean = T_map_sensor_ * motion.T_before_after;
  const Eigen::Vector2d arm = belief.mean.position() - T_map_sensor_.position();
  const Eigen::Matrix3d covariance = leveredCovariance(covariance_, arm) +
                                     rotatedCovariance(motion.covariance, T_map_sensor_.theta);
  belief.information = covariance.inverse();
  return belief;
}

Slam::State::Tracked Slam::State::track(const ScanSurface& surface,
                                        const std::optional<Pose2>& odometry_step) const {
  const MotionBelief motion = motion_.predict(odometry_step);
  const PoseBelief prior = predict(motion);
  const Tracked ahead{odometry_step, motion, prior, tracker_.localise(frames_, surface, prior)};
  if (ahead.found.agreement >= kGoodAgreement || !odometry_step || jump_.isOpen()) return ahead;
  const auto is_better = [&](const Tracked& other) {
    return monitor_.isClearlyBetter(other.found, ahead.found);
  };
  // Some encoders count alike forwards and backwards.
  const Pose2 reversed{-odometry_step->x, -odometry_step->y, odometry_step->theta};
  if (const Tracked behind = trackNear(surface, reversed); is_better(behind)) return behind;
  // Odometry that begins anew leaps further than a search around it reaches.
  const Pose2 leap = motion.T_before_after.inverse() * motion_.predict({}).T_before_after;
  if (leap.position().norm() > kWidestWindowHere || std::abs(leap.theta) > kWidestTurn) {
    if (const Tracked goes_on = trackNear(surface, {}); is_better(goes_on)) return goes_on;
  }
  return ahead;
}

/// By another step than the wheels tell, or none, without a search.
Slam::State::Tracked Slam::State::trackNear(const ScanSurface& surface,
                                            const std::optional<Pose2>& step) const {
  const MotionBelief motion = motion_.predict(step);
  const PoseBelief prior = predict(motion);
  return {step, motion, prior,
          tracker_.matchLocally(frames_, surface, prior, prior.mean, kFirstMatchReach)};
}

/// The robot has been at the other pose since the first scan that suggested it.
void Slam::State::jump() {
  const Pose2& T_map_frame = frames_.graph.pose(frames_.size() - 1);
  const std::vector<Pose2>& poses = jump_.poses();
  const std::size_t earlier = poses.size() - 1;
  for (std::size_t k = 0; k < earlier; ++k) {
    DrivenScan& scan = scans_[scans_.size() - earlier + k];
    scan.T_frame_sensor = poses[k];
    scan.is_doubtful = false;
  }
  odometry_.jumpTo(poses.back());
  if (earlier > 0) T_map_sensor_ = T_map_frame * poses[earlier - 1];
  jump_.reset();
}

/// Takes the matched pose, or the predicted one where the scan is in doubt.
/// @return  whether it is.
bool Slam::State::takePose(const Tracked& tracked, std::size_t returns) {
  const auto& [odometry_step, motion, prior, found] = tracked;
  const Pose2 before = T_map_sensor_;
  const bool is_doubtful = jump_.isOpen() || monitor_.isContradiction(found, returns);
  const bool is_matched = found.match.paired > 0.0 && !is_doubtful;
  T_map_sensor_ = is_matched ? found.match.T_map_query : prior.mean;
  covariance_ =
      is_matched ? found.match.posterior.inverse().eval() : prior.information.inverse().eval();
  if (found.in_common > 0.0 && !jump_.isOpen()) {
    monitor_.learn(found.agreement, is_doubtful, motion.T_before_after);
  }
  if (!is_doubtful) {
    motion_.learn(odometry_step, motion, before.inverse() * T_map_sensor_,
                  rotatedCovariance(covariance_, -before.theta));
  }
  return is_doubtful;
}

int Slam::State::newFrame(const Scan& scan, const Pose2& T_robot_sensor, ScanSurface surface) {
  frames_.surfaces.push_back(std::move(surface));
  key_scans_.push_back({scan, T_robot_sensor});
  corrections_.add(T_map_sensor_);
  odometry_.restart();
  covariance_.setZero();
  return frames_.graph.add(T_map_sensor_);
}

/// Ties a new frame to the last one and to those in view.
void Slam::State::addKeyFrame(int frame, const GraphEdge& odometry, bool is_measured) {
  std::optional<double> scale;
  if (is_measured) scale = 1.0 + motion_.longer();
  back_end_.connectOdometry(frames_.graph, odometry, scale);
  removeMovers(frames_, frame, tracker_.view());
  for (const int other : tracker_.view()) {
    if (auto edge = matchEdge(frames_, other, frame, kStepMatch)) {
      if (other == odometry.from && is_measured) learnScale(odometry, *edge);
      if (other >= frame - kFramesOfVisit) edge->kind = EdgeKind::kMatch;
      back_end_.connectMatch(frames_.graph, *edge);
    }
  }
  back_end_.add(frames_.graph, map_, frame);
  tracker_.lookAround(frames_, frame, frames_.graph.pose(frame));
  T_map_sensor_ = frames_.graph.pose(frame);
}

/// Learns by how much the odometry counts a way too short, from a match of both its ends.
void Slam::State::learnScale(const GraphEdge& odometry, const GraphEdge& match) {
  const Eigen::Vector2d by_odometry = odometry.T_from_to.position();
  const double way = by_odometry.norm();
  if (way == 0.0) return;
  const Eigen::Vector2d ahead = by_odometry / way;
  // Its returns count as if they erred by the reach of the match; they err less. What it says
  // nothing of may be off by a metre.
  const double share = noiseShare(frames_.surfaces[static_cast<std::size_t>(match.to)], kStepMatch);
  const Eigen::Matrix3d covariance =
      (match.information / (share * share) + Eigen::Matrix3d::Identity()).inverse();
  motion_.learnWay(way / (1.0 + motion_.longer()), ahead.dot(match.T_from_to.position()),
                   ahead.dot(covariance.topLeftCorner<2, 2>() * ahead));
}

/// Begins a part of the graph with a frame. The scans in doubt before it were the first that were
/// taken there, where they agree with it.
void Slam::State::startPart(int frame) {
  tracker_.lookAt(frame);
  back_end_.beginPart();
  jump_.reset();
  const std::vector<ScanSurface>& doubtful = monitor_.scans();
  const std::size_t earlier = doubtful.empty() ? 0 : doubtful.size() - 1;
  const ScanSurface& first = frames_.surfaces[static_cast<std::size_t>(frame)];
  for (std::size_t k = 0; k < earlier; ++k) {
    DrivenScan& scan = scans_[scans_.size() - earlier + k];
    scan.T_frame_sensor =
        T_map_sensor_.inverse() * frames_.graph.pose(scan.frame) * scan.T_frame_sensor;
    scan.frame = frame;
    scan.is_doubtful = !monitor_.isUsual(mutualSights(first, doubtful[k], scan.T_frame_sensor));
  }
  monitor_.clear();
  if (frame > 0) corrections_.count();  // what was seen in doubt is nowhere in the map
}

void Slam::State::advanceBackEnd() {
  const int last = frames_.size() - 1;
  const Pose2 before = frames_.graph.pose(last);
  if (!back_end_.advance(frames_, map_, 1.0 + motion_.longer())) return;
  const Pose2& after = frames_.graph.pose(last);
  T_map_sensor_ = after * (before.inverse() * T_map_sensor_);
  covariance_ = rotatedCovariance(covariance_, after.theta - before.theta);
  tracker_.lookAround(frames_, last, after);
  if (back_end_.hasJoined()) corrections_.count();  // what is in the map is more now
  corrections_.update(frames_.graph);
}

void Slam::State::finish(const DoAll& do_all) {
  back_end_.restartCount();
  while (!back_end_.isIdle()) advanceBackEnd();
  back_end_.finish(frames_, map_, 1.0 + motion_.longer(), do_all);
}

SlamPose Slam::State::poseNow(const Pose2& T_robot_sensor, double agreement,
                              const Eigen::Matrix3d& covariance) const {
  SlamPose pose;
  pose.T_map_robot = T_map_sensor_ * T_robot_sensor.inverse();
  pose.covariance = covariance;
  pose.agreement = agreement;
  pose.version = version();
  pose.is_lost = isLost();
  return pose;
}

Slam::Slam(const Pose2& T_map_start) : Slam(T_map_start, matchSurface) {}
Slam::Slam(const Pose2& T_map_start, ScanMatcher matcher)
    : state_(std::make_unique<State>(T_map_start, matcher)) {}
Slam::~Slam() = default;
Slam::Slam(const Slam& other) : state_(std::make_unique<State>(*other.state_)) {}
Slam& Slam::operator=(const Slam& other) { return *this = Slam(other); }
Slam::Slam(Slam&&) noexcept = default;
Slam& Slam::operator=(Slam&&) noexcept = default;

SlamPose Slam::step(const AnalysedScan& analysed, const Pose2& T_robot_sensor,
                    const std::optional<Pose2>& T_odom_robot) {
  return state_->step(analysed, T_robot_sensor, T_odom_robot);
}
std::optional<SweepHalves> Slam::sweepMotion(const AnalysedScan& analysed, const SweptScan& sweep,
                                             const Pose2& T_robot_sensor,
                                             const std::optional<Pose2>& T_odom_robot) {
  return state_->sweepMotion(analysed, sweep, T_robot_sensor, T_odom_robot);
}
SlamPose Slam::step(const Scan& scan, const Pose2& T_robot_sensor,
                    const std::optional<Pose2>& T_odom_robot) {
  return step(analyse(scan), T_robot_sensor, T_odom_robot);
}

void Slam::startAt(const Pose2& T_map_start) { state_->startAt(T_map_start); }
void Slam::remember(const SlamMemory& memory) { state_->remember(memory); }
void Slam::startAnywhere() { state_->startAnywhere(); }
void Slam::finish(const DoAll& do_all) { state_->finish(do_all); }

std::vector<Pose2> Slam::trajectory() const { return state_->trajectory(); }
std::vector<bool> Slam::isLocalised() const { return state_->isLocalised(); }
std::vector<bool> Slam::isSetAside() const { return state_->isSetAside(); }
bool Slam::isLost() const { return state_->isLost(); }
bool Slam::isInMemory() const { return state_->isInMemory(); }
int Slam::remembered() const { return state_->remembered(); }
SlamMemory Slam::memory() const { return state_->memory(); }

const SlamWork& Slam::work() const { return state_->work(); }
bool Slam::isSettled() const { return state_->isSettled(); }
const KeyFrames& Slam::keyFrames() const { return state_->keyFrames(); }
const PoseGraph& Slam::graph() const { return keyFrames().graph; }
const std::vector<LoopVerdict>& Slam::loops() const { return state_->loops(); }
std::size_t Slam::loopsClosed() const { return loops().size(); }
const std::vector<LoopVerdict>& Slam::verdicts() const { return state_->verdicts(); }
const LoopReview& Slam::review() const { return state_->review(); }
int Slam::version() const { return state_->version(); }

}  // namespace cca
