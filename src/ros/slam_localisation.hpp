// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/io/pose_files.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"
#include "cca_mrpt/slam/slam.hpp"
#include "frame_names.hpp"
#include "map_saver.hpp"
#include "node_diagnostics.hpp"
#include "scan_feed.hpp"

namespace cca {

/// Line SLAM as the localisation of REP 105: scans placed in the frame of the odometry become scans
/// placed in the map. The map begins where the robot stands at its first scan. Tells tf
/// map -> odom, `pose`, and `loop_markers`.
class SlamLocalisation {
 public:
  /// @param resume  folder of an earlier map, or its map.slam, to go on with; empty: none. Until
  ///                the robot has found itself in it, its own drive is the map.
  /// @throws std::runtime_error naming the file and what is wrong with it.
  SlamLocalisation(ros::NodeHandle& node, FrameNames frames, const std::string& resume);

  /// @param placed  in: in the frame of the odometry; out: in that of the map.
  /// @return whether the poses of the past have been corrected, see past() and way().
  bool place(PlacedScan& placed);

  /// Places a scan of another laser, by what the last scan of the first has told: the robot is
  /// localised by that one alone. @return  false where it is not known, or lost.
  bool placeBeside(PlacedScan& placed);

  /// The last pass, see Slam::finish(): what loops left to settle is settled, and poses and lines
  /// are made to agree. past() then holds the last scan, too. The next scan may be placed as ever.
  /// Cost: a second for some hundred metres.
  void finish();

  /// Begins anew where the robot is.
  void reset();

  /// The scans before the last one, where they are believed to have been taken.
  const PastScans& past() const { return past_; }
  bool isLost() const { return pose_.is_lost; }
  /// Where the robot was at each scan so far, as believed now.
  std::vector<StampedPose> way() const;

  void tell(NodeDiagnostics& diagnostics) const;
  /// How many scans of the past are of an earlier drive: the first ones.
  std::size_t remembered() const { return static_cast<std::size_t>(slam_.remembered()); }
  bool isInMemory() const { return slam_.isInMemory(); }
  /// For map.slam; from any thread.
  MapMemory memory() const;
  int loops() const { return static_cast<int>(slam_.loops().size()); }

 private:
  void publish(const PlacedScan& placed);
  void showLoops(const ros::Time& stamp);
  void warnOfOthers(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) const;

  FrameNames frames_;
  mutable std::mutex mutex_;  ///< held wherever slam_ is changed
  Slam slam_;
  SlamPose pose_;
  Pose2 T_map_odom_;
  PastScans past_;
  std::optional<PlacedScan> last_;  ///< not yet among the past
  std::vector<double> stamps_;      ///< s, of each scan
  int loops_shown_ = 0;
  ros::Publisher transforms_, poses_, loop_markers_;
  ros::Subscriber others_;
};

/// Waits until it is clear who tells where the robot is.
/// @param tell  is given what is waited for.
/// @return  "tf" as soon as tf joins map and base; "slam" where for five seconds of the wall it has
///          joined no more than odometry and base; empty where the node is to end.
std::string choosePose(ros::NodeHandle& node, const FrameNames& frames,
                       const std::function<void(const std::string&)>& tell);

}  // namespace cca
