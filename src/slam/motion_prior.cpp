// SPDX-License-Identifier: BSD-3-Clause
#include "slam/motion_prior.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

// First guess of the random part, wide: it is scaled by what matches show.
constexpr double kPerWay = 0.10;        // of the way
constexpr double kPerTurn = 0.15;       // of the turn: skids turn most
constexpr double kTurnPerWay = 0.07;    // rad / m: 4 degrees a metre
constexpr double kShiftPerTurn = 0.05;  // m / rad: the axis of turning is known to 5 cm
/// m, rad; what a robot that stands may have been pushed.
constexpr double kStandingShift = 0.02, kStandingTurn = 0.01;
/// Without wheels the robot may have changed its speed altogether.
constexpr double kBlindShift = 0.15, kBlindTurn = 0.15;
/// What errs by so much, three systematic errors, says nothing of these: a wheel has slipped.
constexpr double kSlip = 0.3;
/// The random part of a way from one key frame to the next, of good wheels.
constexpr double kRandomWay = 0.02;
/// What is learned of the way in one place is not so well known in another, floors differ: windows
/// narrower than that take a place for its like more often.
constexpr double kVaries = 0.04;
/// m; of a shorter way a match says too little.
constexpr double kLeastWay = 0.05;
/// Sweeps that the first guess of the change within one stands for.
constexpr double kBelieved = 10.0;
/// Squared deviations: three. One wild step does not undo what hundred have taught.
constexpr double kWild = 9.0;
constexpr double kForgetAfter = 100.0;  // steps: half of what is known is of the last 70
/// Of the first guess's variance: wheels that err by a hundredth of the way, and by a third.
constexpr double kLeastScale = 0.02, kMostScale = 10.0;

double squared(double x) { return x * x; }

double wayVariance(const Pose2& step) {
  return squared(kStandingShift) + squared(kPerWay * step.position().norm()) +
         squared(kShiftPerTurn * step.theta);
}

double turnVariance(const Pose2& step) {
  return squared(kStandingTurn) + squared(kTurnPerWay * step.position().norm()) +
         squared(kPerTurn * step.theta);
}

}  // namespace

MotionBelief MotionPrior::predict(const std::optional<Pose2>& step) const {
  MotionBelief belief;
  if (!step) {
    belief.T_before_after = last_step_;
    belief.covariance.diagonal() << squared(kBlindShift) +
                                        squared(0.5 * last_step_.position().norm()),
        squared(kBlindShift) + squared(0.5 * last_step_.position().norm()),
        squared(kBlindTurn) + squared(0.5 * last_step_.theta);
    return belief;
  }
  const double told = step->position().norm();
  // turn - step.theta = turns_ . (told, turn)
  const double turn = (step->theta + turns_.x() * told) / (1.0 - turns_.y());
  const Eigen::Vector2d x(told, turn);
  // The error of the heading builds up along the way: half of it turns the step.
  const Pose2 half{0.0, 0.0, 0.5 * (turn - step->theta)};
  const Eigen::Vector2d p = half * Eigen::Vector2d(step->position() * (1.0 + longer_));
  belief.T_before_after = {p.x(), p.y(), wrapAngle(turn)};
  const double way =
      scale_ * wayVariance(*step) + squared(told) * std::max(longer_variance_, squared(kVaries));
  belief.covariance.diagonal() << way, way,
      turn_scale_ * turnVariance(*step) + x.dot(turns_covariance_ * x);
  return belief;
}

void MotionPrior::learn(const std::optional<Pose2>& step, const MotionBelief& belief,
                        const Pose2& matched, const Eigen::Matrix3d& covariance) {
  last_step_ = matched;
  if (!step) return;
  // By the turn that the match found: the wheels' own is noise where the robot drives straight on,
  // and regressed on itself it would be taken for an error of each turn, whole.
  const Eigen::Vector2d x(step->position().norm(), matched.theta);
  const Pose2& predicted = belief.T_before_after;
  // Of the random part: what the match found and what it leaves open (so that along a corridor,
  // where matches know nothing, nothing is learned).
  const double turn_error = wrapAngle(matched.theta - predicted.theta);
  const double shift_sq = 0.5 * (matched.position() - predicted.position()).squaredNorm();
  weight_ = std::min(weight_ + 1.0, kForgetAfter);
  const auto follow = [&](double& scale, double found_sq, double unit) {
    const double seen = std::min(found_sq / unit, kWild * scale + 1.0);
    scale += (seen - scale) / (weight_ + 5.0);
    scale = std::clamp(scale, kLeastScale, kMostScale);
  };
  follow(turn_scale_, squared(turn_error) + covariance(2, 2), turnVariance(*step));
  follow(scale_, shift_sq + 0.5 * covariance.topLeftCorner<2, 2>().trace(), wayVariance(*step));

  const double heading_variance = turn_scale_ * turnVariance(*step) + covariance(2, 2);
  const double whole_turn_error = wrapAngle(matched.theta - step->theta);
  if (squared(turn_error) < 9.0 * (belief.covariance(2, 2) + covariance(2, 2)) &&
      std::abs(whole_turn_error) < kSlip * x.norm()) {
    const Eigen::Vector2d known = turns_covariance_ * x;
    const Eigen::Vector2d gain = known / (x.dot(known) + heading_variance);
    turns_ += gain * (whole_turn_error - turns_.dot(x));
    turns_covariance_ -= gain * known.transpose();
  }
}

void MotionPrior::learnChange(double error, double expected) {
  if (!(expected > 0.0)) return;
  if (change_weight_ == 0.0) change_weight_ = kBelieved * expected;
  change_weight_ += expected - change_weight_ / kForgetAfter;
  const double bound = kWild * change_share_ + 1.0;
  const double seen = std::clamp(error / expected, -bound, bound);
  change_share_ += (seen - change_share_) * expected / change_weight_;
  change_share_ = std::clamp(change_share_, kLeastScale, kMostScale);
}

void MotionPrior::learnWay(double way, double matched, double variance) {
  if (way < kLeastWay || std::abs(matched - way) > kSlip * way) return;
  const double error = matched - way * (1.0 + longer_);
  const double systematic = way * way * longer_variance_;
  double random = squared(kRandomWay * way) + variance;
  // What errs by more than three sigmas counts the less, as by Huber. Did it not count, a first way
  // that erred would never be unlearned: all the right ones would contradict it.
  random *= std::max(1.0, squared(error) / (9.0 * (systematic + random)));
  const double gain = way * longer_variance_ / (systematic + random);
  longer_ += gain * error;
  longer_variance_ -= gain * way * longer_variance_;
}

}  // namespace cca
