// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "cca_mrpt/localisation/localiser.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "ros/input/scan_feed.hpp"
#include "ros/input/transforms.hpp"
#include "slam/external_corrections.hpp"

namespace cca {

/// The localiser of a node. @param pose  its parameter: tf, odometry or slam.
/// @param corrections  whether the past is corrected where tf's map -> odom leaps.
std::unique_ptr<Localiser> makeLocaliser(const std::string& pose, bool corrections,
                                         const CcaParameters& mapping);

/// @param is_in_odometry  the fixed frame of the scan is that of the odometry, else the map.
Measurement measurementOf(const PlacedScan& placed, bool is_in_odometry);

/// `corrected_path` (nav_msgs/Path, poses of the robot with stamps): who localises the robot
/// publishes its way as corrected.
/// @param corrections  that take it; to outlive the subscriber.
ros::Subscriber hearCorrectedPath(ros::NodeHandle& node, ExternalCorrections& corrections);

/// Logs that the past has been corrected, and by what.
void logCorrection(const ExternalCorrections& corrections);

/// Waits until it is clear who tells where the robot is, and logs it.
/// @param tell  is given what is waited for.
/// @return  "tf" as soon as tf joins map and base; "slam" where for five seconds of the wall it has
///          joined no more than odometry and base; empty where the node is to end.
std::string choosePose(ros::NodeHandle& node, const FrameNames& frames,
                       const std::function<void(const std::string&)>& tell);

}  // namespace cca
