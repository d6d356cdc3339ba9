// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// A motion as one source tells it: where the sensor got to, in the frame that it had before.
struct MotionBelief {
  Pose2 T_before_after;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< m^2, m rad, rad^2; axes of `before`
};

/// What the wheels are worth: how far matches had to correct them, learned as the robot drives,
/// beginning wide [Thrun, Burgard & Fox 2005, ch. 5; Vizzo et al. 2023].
///
/// The error of a step is a systematic part, linear in way and turn, and a random one whose
/// variances grow with way and turn. Both are learned from matches, by as much as these knew
/// better.
///
/// By how much the wheels count a way too short is learned from one key frame to the next: two
/// matches to the same walls differ by less than the errors of all the steps between them add up
/// to.
class MotionPrior {
 public:
  /// @param step  of the wheels, in the frame of the sensor; nothing: the robot goes on as it went.
  MotionBelief predict(const std::optional<Pose2>& step) const;

  /// @param step       as given to predict().
  /// @param belief     what predict() made of it.
  /// @param matched    the same motion after the match.
  /// @param covariance of the match with the prior, axes of the pose before.
  void learn(const std::optional<Pose2>& step, const MotionBelief& belief, const Pose2& matched,
             const Eigen::Matrix3d& covariance);

  /// @param way       m, from one key frame to the next as the wheels tell it.
  /// @param matched   m, the same way by a match of these two alone.
  /// @param variance  m^2, of that match.
  void learnWay(double way, double matched, double variance);

  /// @param error, expected  see SweepFit, of the wheels' change of motion within a sweep.
  void learnChange(double error, double expected);
  /// The variance of the change of motion within a sweep that the wheels tell, as a share of what
  /// predict() has of a step like it: wheels that err by slip, not by noise, tell it well.
  double changeShare() const { return change_share_; }

  /// A way is longer than the wheels tell by this share of it, as predict() has it.
  double longer() const { return longer_; }

 private:
  /// A systematic error is not above these: a tenth of the way, .1 rad a metre, a tenth of the
  /// turn.
  static constexpr double kSystematic = 0.1;

  // Of the heading, by (way as told, turn as it was): recursive least squares.
  Eigen::Vector2d turns_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d turns_covariance_ = kSystematic * kSystematic * Eigen::Matrix2d::Identity();
  double longer_ = 0.0, longer_variance_ = kSystematic * kSystematic;
  double scale_ = 1.0,
         turn_scale_ = 1.0;  ///< of the random part's variances, over their first guess
  double change_share_ = 1.0, change_weight_ = 0.0;
  double weight_ = 0.0;  ///< of what the scales have been learned from, bounded
  Pose2 last_step_;
};

}  // namespace cca
