// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// MRPT's side of ParticleSlam, behind lateFunction().
class ParticleFilter {
 public:
  virtual ~ParticleFilter() = default;
  /// T_start_robot: that of the first scan is the identity.
  virtual void step(const Scan& scan, const Pose2& T_robot_sensor,
                    const std::optional<Pose2>& T_odom_robot) = 0;
  virtual std::vector<Pose2> trajectory() const = 0;
};

/// Where the robot was, by MRPT's RBPF-SLAM (CMetricMapBuilderRBPF): particles with a map of points
/// each, moved to where the scan matches it [Grisetti et al. 2007]; the settings are those that
/// MRPT ships for the intel log. The same input gives the same poses.
class ParticleSlam {
 public:
  /// @throws std::runtime_error where the library that holds MRPT's SLAM cannot be loaded.
  explicit ParticleSlam(const Pose2& T_map_start);

  /// @param scan          T_map_sensor is not used.
  /// @param T_odom_robot  in any frame that stays; nothing: the robot stands.
  void step(const Scan& scan, const Pose2& T_robot_sensor,
            const std::optional<Pose2>& T_odom_robot) {
    filter_->step(scan, T_robot_sensor, T_odom_robot);
  }
  /// T_map_robot of each scan, of the likeliest particle.
  std::vector<Pose2> trajectory() const;

 private:
  Pose2 T_map_start_;
  std::unique_ptr<ParticleFilter> filter_;
};

}  // namespace cca
