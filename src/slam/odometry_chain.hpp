// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cca_mrpt/slam/pose_graph.hpp"
#include "slam/motion_prior.hpp"

namespace cca {

/// The odometry since the last key frame: the next edge of the pose graph.
class OdometryChain {
 public:
  /// @param T_odom_sensor  now; nothing: the odometry is silent.
  /// @return  the step since the last scan; nothing where the odometry was silent at either.
  std::optional<Pose2> stepTo(const std::optional<Pose2>& T_odom_sensor) const;
  /// The last scan is there.
  void moveTo(const std::optional<Pose2>& T_odom_sensor) { last_odom_sensor_ = T_odom_sensor; }

  /// A key frame is taken here.
  void restart();
  /// Adds a step.
  /// @param is_measured  by odometry; otherwise the robot is presumed to go on as it went.
  void extend(const MotionBelief& motion, bool is_measured);
  /// The robot has jumped, which the odometry has not seen: it says next to nothing of how the
  /// robot came from the key frame to this pose in it.
  void jumpTo(const Pose2& T_frame_sensor);

  /// Whether the odometry has measured each step since the key frame.
  bool isMeasured() const { return is_measured_; }
  /// From key frame `from` to the next one, which is taken now.
  GraphEdge edge(int from) const;

 private:
  std::optional<Pose2> last_odom_sensor_;
  Pose2 T_frame_sensor_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  bool is_measured_ = true;
};

}  // namespace cca
