// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include <deque>
#include <functional>
#include <map>
#include <string>

#include "cca_mrpt/mapping/missing_returns.hpp"
#include "cca_mrpt/mapping/scan.hpp"
#include "cca_mrpt/ros/pose_gate.hpp"
#include "transform_feed.hpp"

namespace cca {

/// A scan that may be used: sound, in order, and at a pose that tf vouches for.
struct PlacedScan {
  Scan scan;
  Pose2 T_map_robot;
  ros::Time stamp;    ///< of the message, its first beam
  std::string frame;  ///< of the message
};

/// Turns `scan` and tf into placed scans. What cannot be used is dropped, counted by reason, and
/// told at most once in five seconds: a message that no laser can have meant, a blind one (hardly a
/// valid beam, or none that returned), one not newer than the last, one too old to drive by, one
/// that tf knows no pose for, one after which the pose leapt. Lives in the thread that spins.
class ScanFeed {
 public:
  struct Frames {
    std::string map = "map";
    std::string robot;  ///< empty: the robot's own frame is not asked for, and stays the sensor's
  };
  using Sink = std::function<void(const PlacedScan&)>;

  /// @param oldest  s; a scan older than this when it could be used is dropped. 0: any age, for
  ///                mapping without driving.
  ScanFeed(ros::NodeHandle& node, Frames frames, double oldest, Sink sink);

  const std::map<std::string, long>& dropped() const { return dropped_; }
  /// Why the last scan was dropped or still waits, as ": reason"; empty where it was used.
  const std::string& lastTrouble() const { return last_trouble_; }

 private:
  struct Waiting {
    Scan scan;
    ros::Time stamp, middle;
    std::string frame;
  };

  void receive(const sensor_msgs::LaserScan& message);
  void serve();
  void use(const Waiting& waiting);
  void dropFirst();
  bool hasPose(const Waiting& waiting) const;
  std::string whyNoPose(const Waiting& waiting) const;
  void drop(const std::string& reason, const std::string& detail = "");
  void startAnewIfClockWasSetBack();
  bool isFromTheFuture(const ros::Time& stamp) const;

  Frames frames_;
  double oldest_;
  Sink sink_;
  std::deque<Waiting> waiting_;
  PoseGate gate_;
  MissingReturns missing_returns_;
  ros::Time last_stamp_, last_now_;
  std::string last_trouble_;
  std::map<std::string, long> dropped_;
  TransformFeed transforms_;  // these two last: they call what stands above
  ros::Subscriber scans_;
};

}  // namespace cca
