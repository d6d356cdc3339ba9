// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <topic_tools/shape_shifter.h>

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cca_mrpt/sensing/missing_returns.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "ros/input/pose_gate.hpp"
#include "ros/input/scan_placement.hpp"
#include "scan_period.hpp"
#include "sensing/scan_faults.hpp"
#include "transform_feed.hpp"

namespace cca {

/// Of a LaserScan, or the first echoes of a MultiEchoLaserScan.
/// @throws std::runtime_error where it holds no scan.
sensor_msgs::LaserScan scanOf(const topic_tools::ShapeShifter& message);

/// A scan that may be used: sound, and at a pose that tf vouches for.
struct PlacedScan {
  Scan scan;              ///< T_map_sensor is in the fixed frame
  ros::Time stamp;        ///< of the message, its first beam
  ros::Time middle;       ///< of the sweep: of the poses
  ros::Time arrival;      ///< of the message here
  std::string frame;      ///< of the message: which laser
  std::size_t topic = 0;  ///< which of the topics it came by
  ScanPlacement at = {};
};

/// Turns scans (sensor_msgs/LaserScan, or the first echoes of MultiEchoLaserScan) and tf into
/// placed scans, as the laser took them, with their motion. A scan waits until tf has come to its
/// middle; for mapping, to its end. What cannot be used is dropped,
/// counted by reason, and told at most once in five seconds.
///
/// For mapping, that is a message that no laser can have meant, and a scan that tf knows no pose
/// for: the same as in `cca-mrpt map BAG`. Who drives can use no blind scan either (hardly a valid
/// beam, or none that returned), none that is not newer than the last of its laser, is too old to
/// drive by (see ScanPeriod::oldest()) or from the future, and none after which the pose leapt.
/// Lives in the thread that spins.
class ScanFeed {
 public:
  struct Settings {
    std::vector<std::string> topics;
    PlacementFrames frames;
    double oldest = 0.0;  ///< s, of a scan of one instant that may be driven by; 0: mapping only
  };
  using Sink = std::function<void(const PlacedScan&)>;

  ScanFeed(ros::NodeHandle& node, Settings settings, Sink sink);
  /// No more comes: scans that wait for the end of their sweep are used as they are.
  void finish();

  const Transforms& transforms() const { return transforms_.transforms(); }
  /// Of the laser of that topic.
  const ScanPeriod& period(std::size_t topic) const { return periods_[topic]; }
  const std::map<std::string, long>& dropped() const { return dropped_; }
  /// Why none can come, or the last scan was dropped or still waits, as ": reason"; empty where it
  /// was used.
  std::string lastTrouble() const;

 private:
  enum class Pose { kKnown, kExpected, kNever };

  using Event = ros::MessageEvent<const topic_tools::ShapeShifter>;

  void receive(const Event& event, std::size_t topic);
  void serve();
  void use(PlacedScan& placed);
  bool drives() const { return settings_.oldest > 0.0; }
  /// Why a scan that has just come must not be driven by; empty where it may.
  std::string whyUnfit(const PlacedScan& waiting) const;
  std::optional<ros::Time> latestPose(const std::string& laser_frame) const;
  Pose pose(const PlacedScan& waiting, const std::optional<ros::Time>& latest) const;
  std::string whyNoPose(const PlacedScan& waiting) const;
  /// @param rule  that the scan broke: the first scan of each reason and rule is told at once.
  void drop(const std::string& reason, const std::string& detail = "",
            const std::string& rule = "");
  void startAnewIfClockWasSetBack();
  /// Why none can come; empty where they can.
  std::string whySilent() const;

  Settings settings_;
  Sink sink_;
  std::deque<PlacedScan> waiting_;  ///< not placed yet
  PoseGate gate_;
  std::map<std::string, MissingReturns> missing_returns_;  ///< of each laser, by its frame
  std::map<std::string, ScanFaults> faults_;               ///< the same
  std::map<std::string, ros::Time> last_stamps_;           ///< the same
  std::vector<ScanPeriod> periods_;                        ///< by topic
  ros::Time last_now_;
  bool is_at_end_ = false;
  std::string last_trouble_;
  std::map<std::string, long> dropped_;
  std::set<std::string> told_;  ///< reasons and rules
  TransformFeed transforms_;    // these two last: they call what stands above
  std::vector<ros::Subscriber> scans_;
  std::string told_silence_;
  ros::WallTimer silence_timer_;  // by the wall: that there is no other time is one of the causes
};

}  // namespace cca
