// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/wheel_track.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

/// m: matches at both ends of such a way err by less than wheels do on it.
constexpr double kJudgedWay = 1.0;
/// What wheels may err by while the robot is lost: at once [m, rad], of the way [m/m, rad/m], and
/// of turns [rad/rad].
constexpr double kWheelReach = 0.5, kWheelTurn = 0.25, kWheelPerWay = 0.15, kWheelTurnPerWay = 0.05,
                 kWheelTurnPerTurn = 0.05;

}  // namespace

void WheelTrack::add(const Pose2& T_before_after) {
  T_wheels_sensor_ = T_wheels_sensor_ * T_before_after;
  way_ += T_before_after.position().norm();
  turn_ += std::abs(T_before_after.theta);
}

void WheelTrack::trust(const Pose2& T_map_sensor) {
  trusted_ = {T_map_sensor * T_wheels_sensor_.inverse(), way_, turn_};
}

std::optional<Expectation> WheelTrack::expectation() const {
  if (!trusted_) return {};
  const double way = way_ - trusted_->way, turn = turn_ - trusted_->turn;
  Expectation expectation;
  expectation.T_map_wheels = trusted_->T_map_wheels;
  expectation.reach = std::min(kWheelReach + kWheelPerWay * way, Expectation::kWidestReach);
  expectation.turn = std::min(kWheelTurn + kWheelTurnPerWay * way + kWheelTurnPerTurn * turn,
                              Expectation::kWidestTurn);
  return expectation;
}

std::optional<JudgedWay> WheelTrack::judge(const Pose2& T_map_sensor,
                                           const Eigen::Matrix2d& covariance) {
  std::optional<JudgedWay> judged;
  if (anchor_) {
    const Eigen::Vector2d by_wheels =
        (anchor_->T_wheels_sensor.inverse() * T_wheels_sensor_).position();
    const double way = by_wheels.norm();
    if (way < kJudgedWay) return {};
    const Eigen::Vector2d matched = T_map_sensor.position() - anchor_->T_map_sensor.position();
    const Eigen::Vector2d ahead = Pose2{0.0, 0.0, anchor_->T_map_sensor.theta} * (by_wheels / way);
    judged = {way, ahead.dot(matched), ahead.dot((anchor_->covariance + covariance) * ahead)};
  }
  anchor_ = {T_map_sensor, T_wheels_sensor_, covariance};
  return judged;
}

}  // namespace cca
