// SPDX-License-Identifier: BSD-3-Clause
#include "slam/odometry_chain.hpp"

#include <Eigen/LU>

#include "slam/pose_covariance.hpp"

namespace cca {
namespace {

/// m^2, rad^2; variance of the odometry over a jump: the size of the search for it.
constexpr double kJumpVariance = 1.0;

}  // namespace

std::optional<Pose2> OdometryChain::stepTo(const std::optional<Pose2>& T_odom_sensor) const {
  if (!T_odom_sensor || !last_odom_sensor_) return std::nullopt;
  return last_odom_sensor_->inverse() * *T_odom_sensor;
}

void OdometryChain::restart() {
  T_frame_sensor_ = {};
  is_measured_ = true;
  covariance_.setZero();
}

void OdometryChain::extend(const MotionBelief& motion, bool is_measured) {
  const Eigen::Vector2d arm =
      T_frame_sensor_ * motion.T_before_after.position() - T_frame_sensor_.position();
  covariance_ = leveredCovariance(covariance_, arm) +
                rotatedCovariance(motion.covariance, T_frame_sensor_.theta);
  T_frame_sensor_ = T_frame_sensor_ * motion.T_before_after;
  is_measured_ = is_measured_ && is_measured;
}

void OdometryChain::jumpTo(const Pose2& T_frame_sensor) {
  T_frame_sensor_ = T_frame_sensor;
  covariance_ += kJumpVariance * Eigen::Matrix3d::Identity();
  is_measured_ = false;
}

GraphEdge OdometryChain::edge(int from) const {
  return {from, from + 1, T_frame_sensor_, covariance_.inverse(), EdgeKind::kWheels};
}

}  // namespace cca
