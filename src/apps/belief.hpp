// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/io/icp_localizer.hpp"
#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/slam/slam.hpp"

namespace cca::apps {

/// Where the robot of a simulation believes to be, whatever --pose its belief comes from.
class Belief {
 public:
  Belief(const Parameters& parameters, const Pose2& T_map_start);

  /// Goes on with an earlier map, from anywhere in it: to be called first, by line SLAM only.
  void remember(const SlamMemory& memory);

  /// Replaces the true pose of an observation by what the robot believes.
  /// @return whether the poses of the past have been corrected, see past().
  bool replacePose(Observation& observation, const Pose2& T_odom_robot);

  /// The last pass over the whole way. @return whether the poses have been corrected.
  bool finish();

  /// The scans to make maps from, where they are believed to have been taken.
  const PastScans& past() const { return past_; }
  /// How many of these are of an earlier map: the first ones.
  std::size_t remembered() const {
    return slam_ ? static_cast<std::size_t>(slam_->remembered()) : 0;
  }
  /// T_map_robot of all scans of this drive, in their order, as believed now.
  const std::vector<Pose2>& trajectory() const { return trajectory_; }
  const std::string& source() const { return source_; }
  int loops() const { return slam_ ? static_cast<int>(slam_->loops().size()) : 0; }
  int corrections() const { return version_; }
  /// Line SLAM, where the belief comes from it.
  const Slam* slam() const { return slam_ ? &*slam_ : nullptr; }

 private:
  void correctPast();

  std::string source_;
  std::optional<IcpLocalizer> icp_;
  std::optional<Slam> slam_;
  int version_ = 0;
  PastScans past_;
  std::vector<Pose2> trajectory_;
};

}  // namespace cca::apps
