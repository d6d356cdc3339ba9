// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <ros/ros.h>

#include <vector>

#include "cca_mrpt/io/pose_files.hpp"
#include "cca_mrpt/slam/outer_corrections.hpp"
#include "scan_feed.hpp"

namespace cca {

/// OuterCorrections of a localisation that tf tells of; `corrected_path` where it publishes its way
/// as corrected (nav_msgs/Path, poses of the robot with stamps).
class OuterLocalisation {
 public:
  OuterLocalisation(ros::NodeHandle& node, const CcaParameters& mapping);

  /// @param placed  with T_odom_robot; without it nothing is known of what to correct.
  /// @return whether the past() was placed anew.
  bool take(const PlacedScan& placed);
  void reset() { corrections_ = OuterCorrections(mapping_); }

  const PastScans& past() const { return corrections_.past(); }
  std::vector<StampedPose> way() const;

 private:
  void correct(const nav_msgs::Path& path);

  CcaParameters mapping_;
  OuterCorrections corrections_;
  ros::Subscriber path_;
};

}  // namespace cca
