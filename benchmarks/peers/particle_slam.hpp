// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca::peers {

class ParticleFilter;

/// Where the robot was, by MRPT's RBPF-SLAM (CMetricMapBuilderRBPF): particles with a map of points
/// each, moved to where the scan matches it [Grisetti et al. 2007]; the settings are those that
/// MRPT ships for the intel log. The same input gives the same poses.
class ParticleSlam {
 public:
  explicit ParticleSlam(const Pose2& T_map_start);
  ~ParticleSlam();

  /// @param scan          T_map_sensor is not used.
  /// @param T_odom_robot  in any frame that stays; nothing: the robot stands.
  void step(const Scan& scan, const Pose2& T_robot_sensor,
            const std::optional<Pose2>& T_odom_robot);
  /// T_map_robot of each scan, of the likeliest particle.
  std::vector<Pose2> trajectory() const;

 private:
  Pose2 T_map_start_;
  std::unique_ptr<ParticleFilter> filter_;
};

}  // namespace cca::peers
