// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/slam.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr double kFrameDistance = 0.5;  // m
constexpr double kFrameTurn = 0.35;     // rad
constexpr int kViewFrames = 10;
constexpr double kSearchCell = 0.05, kSearchSpacing = 0.1, kSearchReach = 12.0;
constexpr int kSearchLevels = 3;
constexpr double kSearchSigmas = 3.0;
constexpr double kWidestSearch = 1.0, kWidestTurn = 1.0;
constexpr double kLeastSearch = 0.2, kLeastTurn = 0.2;
constexpr double kFirstReach = 0.3;  // m, of a match
constexpr std::size_t kJudges = 3;   // frames that say how well a scan agrees with them
constexpr double kAgree = 0.2;       // m, within which rays do
/// A scan that agrees less is looked for in all directions; nearly all that are right agree by
/// more.
constexpr double kDoubtful = 0.6, kClearlyBetter = 0.2, kVague = 1e-3;

/// Two loops speak of one place where they lie this near [m] to each other.
constexpr double kNeighbourWay = 12.0;
/// Poses are solved for again when the graph has grown by this, and by this share: all solutions of
/// a drive together cost a few of the last one.
constexpr int kSettleAfter = 15, kSettleShare = 10;
/// The past has been corrected where a pose of it has moved by this since the last time [m]: about
/// what the maps made from it can tell.
constexpr double kCorrection = 0.05;

bool isCredible(const LoopVerdict& verdict) {
  return verdict.agreement > 0.8 && verdict.common > 0.15 &&
         verdict.runner_up < 0.9 * verdict.score;
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& matrix, double angle) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R * matrix * R.transpose();
}

bool isFinite(const Pose2& pose) {
  return pose.position().allFinite() && std::isfinite(pose.theta);
}

/// How a heading error of the frame turns a position in it.
Eigen::Matrix3d carried(const Eigen::Matrix3d& covariance, const Eigen::Vector2d& arm) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J(0, 2) = -arm.y();
  J(1, 2) = arm.x();
  return J * covariance * J.transpose();
}

}  // namespace

bool Slam::isNewPlace(const Pose2& T_map_sensor, const ScanSurface& surface) const {
  const Pose2& last = frames_.graph.pose(frames_.size() - 1);
  const double turn = std::abs(wrapAngle(T_map_sensor.theta - last.theta));
  return (T_map_sensor.position() - last.position()).norm() >= kFrameDistance ||
         (turn >= kFrameTurn && !surface.is_full_turn);
}

SearchWindow Slam::windowOf(const PoseBelief& prior) {
  const Eigen::Matrix3d covariance = prior.information.inverse();
  const double sigma = std::sqrt(0.5 * covariance.topLeftCorner<2, 2>().trace());
  const double turn_sigma = std::sqrt(covariance(2, 2));
  SearchWindow window;
  window.centre = prior.mean;
  window.half_width = std::clamp(kSearchSigmas * sigma, kLeastSearch, kWidestSearch);
  window.half_turn = std::clamp(kSearchSigmas * turn_sigma, kLeastTurn, kWidestTurn);
  window.prior_information = prior.information.diagonal();
  return window;
}

Pose2 Slam::searched(const ScanSurface& surface, SearchWindow window) const {
  std::vector<Eigen::Vector2d> points, query;
  for (const PlacedSurface& placed : frames_.placed(view_)) {
    for (const auto& point : placed.surface->points) {
      points.push_back(placed.T_map_sensor * point.position);
    }
  }
  for (const auto& point : surface.points) {
    if (point.position.norm() < kSearchReach) query.push_back(point.position);
  }
  query = thinned(query, kSearchSpacing);
  if (query.empty()) return window.centre;
  window.prior_weight = 1.0 / (kIndependent * 3.0 * static_cast<double>(query.size()));
  const LikelihoodPyramid pyramid(points, window.centre.position(),
                                  kSearchReach + window.half_width, kSearchLevels, kSearchCell);
  const auto found = searchPose(query, pyramid, window, 0.2);
  return found ? found->T_map_query : window.centre;
}

Slam::Located Slam::located(const ScanSurface& surface, const PoseBelief& prior,
                            const SearchWindow& window) const {
  const std::vector<PlacedSurface> references = frames_.placed(view_);
  Located found;
  found.match = matchSurface(surface, searched(surface, window), prior, references, kFirstReach);
  SightCount sights;
  for (std::size_t i = 0; i < references.size() && i < kJudges; ++i) {
    sights += compareSights(*references[i].surface, surface,
                            references[i].T_map_sensor.inverse() * found.match.T_map_query, kAgree);
  }
  found.agreement = sights.agreement();
  return found;
}

SlamPose Slam::step(const Scan& scan, const Pose2& T_robot_sensor,
                    const std::optional<Pose2>& T_odom_robot) {
  ScanSurface surface = scanSurface(scan);
  std::optional<Pose2> wheel_step;
  std::optional<Pose2> T_odom_sensor;
  if (T_odom_robot && isFinite(*T_odom_robot)) T_odom_sensor = *T_odom_robot * T_robot_sensor;
  if (T_odom_sensor && last_odom_sensor_) {
    wheel_step = last_odom_sensor_->inverse() * *T_odom_sensor;
  }
  last_odom_sensor_ = T_odom_sensor;

  SlamPose result;
  if (frames_.size() == 0) {
    T_map_sensor_ = T_map_start_ * T_robot_sensor;
    frames_.surfaces.push_back(std::move(surface));
    frames_.graph.add(T_map_sensor_);
    at_version_.push_back(T_map_sensor_);
    view_ = {0};
    passed_.push_back({0, {}, T_robot_sensor});
    result.T_map_robot = T_map_start_;
    result.agreement = 1.0;
    return result;
  }
  const MotionBelief motion = motion_.predict(wheel_step);
  PoseBelief prior;
  prior.mean = T_map_sensor_ * motion.T_before_after;
  const Eigen::Matrix3d step_covariance = turned(motion.covariance, T_map_sensor_.theta);
  const Eigen::Vector2d arm = prior.mean.position() - T_map_sensor_.position();
  const Eigen::Matrix3d prior_covariance = carried(covariance_, arm) + step_covariance;
  prior.information = prior_covariance.inverse();
  // Of the wheels alone, since the last key frame.
  const Eigen::Vector2d wheel_arm =
      T_frame_wheels_ * motion.T_before_after.position() - T_frame_wheels_.position();
  wheels_covariance_ =
      carried(wheels_covariance_, wheel_arm) + turned(motion.covariance, T_frame_wheels_.theta);
  T_frame_wheels_ = T_frame_wheels_ * motion.T_before_after;

  Located found = located(surface, prior, windowOf(prior));
  if (found.agreement < kDoubtful && !surface.points.empty()) {
    // Somebody has turned the robot, or the wheels have told nothing of a turn.
    SearchWindow anywhere;
    anywhere.centre = prior.mean;
    anywhere.half_width = kWidestSearch;
    anywhere.half_turn = M_PI;
    PoseBelief vague = prior;
    vague.information *= kVague;
    const Located other = located(surface, vague, anywhere);
    if (other.agreement > found.agreement + kClearlyBetter) found = other;
  }
  const MatchResult& match = found.match;
  const Pose2 before = T_map_sensor_;
  T_map_sensor_ = match.paired > 0.0 ? match.T_map_query : prior.mean;
  covariance_ = match.paired > 0.0 ? Eigen::Matrix3d(match.posterior.inverse()) : prior_covariance;
  motion_.learn(wheel_step, motion, before.inverse() * T_map_sensor_,
                turned(covariance_, -before.theta));

  result.agreement = found.agreement;
  if (isNewPlace(T_map_sensor_, surface)) {
    addKeyFrame(std::move(surface), T_map_sensor_, T_frame_wheels_, wheels_covariance_.inverse());
    T_map_sensor_ = frames_.graph.pose(frames_.size() - 1);
  }
  const int frame = frames_.size() - 1;
  passed_.push_back({frame, frames_.graph.pose(frame).inverse() * T_map_sensor_, T_robot_sensor});
  result.T_map_robot = T_map_sensor_ * T_robot_sensor.inverse();
  result.covariance = covariance_;
  result.version = version_;
  return result;
}

void Slam::addKeyFrame(ScanSurface surface, const Pose2& T_map_sensor, const Pose2& wheels,
                       const Eigen::Matrix3d& wheels_information) {
  frames_.surfaces.push_back(std::move(surface));
  const int frame = frames_.graph.add(T_map_sensor);
  at_version_.push_back(T_map_sensor);
  const GraphEdge wheel_edge{frame - 1, frame, wheels, wheels_information, false};
  wheel_edges_.push_back(wheel_edge);
  frames_.graph.connect(wheel_edge);
  for (const int other : view_) {
    if (auto edge = matchEdge(frames_, other, frame, {0.15, 0.04})) {
      edge->is_loop = other < frame - 20;
      unsettled_ = unsettled_ || edge->is_loop;
      frames_.graph.connect(*edge);
    }
  }
  T_frame_wheels_ = {};
  wheels_covariance_.setZero();
  covariance_.setZero();
  closeLoops(frame);
  view_ = framesInView(frames_, frame, frames_.graph.pose(frame), kViewFrames);
}

bool Slam::agree(const LoopVerdict& a, const LoopVerdict& b) const {
  const PoseGraph& graph = frames_.graph;
  const Pose2 T_b_a = graph.pose(b.candidate).inverse() * graph.pose(a.candidate);
  const Pose2 T_frames = graph.pose(a.frame).inverse() * graph.pose(b.frame);
  const Pose2 off = (T_b_a * a.T_candidate_frame * T_frames).inverse() * b.T_candidate_frame;
  // Both chains may have drifted a little between the two.
  const double way = T_b_a.position().norm() + T_frames.position().norm();
  return way < kNeighbourWay && off.position().norm() < 0.15 + 0.02 * way &&
         std::abs(off.theta) < 0.03 + 0.005 * way;
}

void Slam::closeLoops(int frame) {
  bool closed = false;
  for (const RelativeCovariance& candidate : loopCandidates(frames_, frame)) {
    const auto verdict = findLoop(frames_, frame, candidate);
    if (!verdict) continue;
    verdicts_.push_back(*verdict);
    if (!isCredible(*verdict)) continue;
    for (const LoopVerdict& other : waiting_) {
      if (other.frame == frame || !agree(*verdict, other)) continue;
      accept(other);
      accept(*verdict);
      closed = true;
      break;
    }
    if (closed) break;
    waiting_.push_back(*verdict);
  }
  if (closed) waiting_.clear();
  unsettled_ = closed || unsettled_;
  const bool is_due = closed || (unsettled_ && frame - last_optimised_ >=
                                                   std::max(kSettleAfter, frame / kSettleShare));
  if (!is_due) return;
  if (closed) {
    frames_.graph.closeLoops();
    for (const int other : framesInView(frames_, frame, frames_.graph.pose(frame), kViewFrames)) {
      if (other >= frame - kViewFrames) continue;
      const auto edge = matchEdge(frames_, other, frame, {0.3, 0.08});
      if (edge) frames_.graph.connect(*edge);
    }
  }
  frames_.graph.optimise();
  last_optimised_ = frame;
  unsettled_ = false;
  countVersion();
}

void Slam::countVersion() {
  double moved = 0.0;
  for (std::size_t k = 0; k < at_version_.size(); ++k) {
    moved = std::max(
        moved,
        (frames_.graph.pose(static_cast<int>(k)).position() - at_version_[k].position()).norm());
  }
  if (moved <= kCorrection) return;
  for (int k = 0; k < frames_.size(); ++k)
    at_version_[static_cast<std::size_t>(k)] = frames_.graph.pose(k);
  ++version_;
}

void Slam::accept(const LoopVerdict& verdict) {
  GraphEdge edge{verdict.candidate, verdict.frame, verdict.T_candidate_frame, verdict.information,
                 true};
  frames_.graph.connect(edge);
  loops_.push_back(verdict);
}

void Slam::finish() { adjust(frames_, wheel_edges_, 10); }

std::vector<Pose2> Slam::trajectory() const {
  std::vector<Pose2> poses;
  for (const Passed& scan : passed_) {
    poses.push_back(frames_.graph.pose(scan.frame) * scan.T_frame_sensor *
                    scan.T_robot_sensor.inverse());
  }
  return poses;
}

}  // namespace cca
