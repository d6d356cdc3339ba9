// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "ros/input/transforms.hpp"

namespace cca {

/// One thing that a robot was asked about.
struct Finding {
  enum class Kind { kGood, kNote, kFault } kind;
  std::string what;    ///< with its figures
  std::string remedy;  ///< the parameter to set, or what to do; empty where nothing is to be done
};

struct Findings : std::vector<Finding> {
  void good(const std::string& what) { push_back({Finding::Kind::kGood, what, ""}); }
  void note(const std::string& what, const std::string& remedy) {
    push_back({Finding::Kind::kNote, what, remedy});
  }
  void fault(const std::string& what, const std::string& remedy) {
    push_back({Finding::Kind::kFault, what, remedy});
  }
};

/// What a robot sends while it is listened to: whether it is all that exploring or mapping needs.
/// It asks no master and sends nothing.
class RobotCheck {
 public:
  struct Settings {
    std::string odom_frame = "odom", base_frame = "base_link", map_frame = "map";
    double radius = 0.25;  ///< m, of the robot
  };

  explicit RobotCheck(Settings settings) : settings_(std::move(settings)) {}

  /// @param arrival  in ROS time.
  void take(const sensor_msgs::LaserScan& scan, const ros::Time& arrival) {
    scans_.push_back(scan);
    scan_ages_.push_back((arrival - scan.header.stamp).toSec());
  }
  void take(const nav_msgs::Odometry& odometry) { odometry_.push_back(odometry); }
  /// @param sender  the node.
  void take(const tf2_msgs::TFMessage& transforms, const std::string& sender);
  /// @param age  s, of tf's last odom -> base when a scan comes.
  void takePoseAge(double age) { pose_ages_.push_back(age); }

  std::size_t scans() const { return scans_.size(); }
  bool hasOdometry() const { return !odometry_.empty(); }

  /// All findings, good ones first of each kind of message. Cost: line SLAM over the scans.
  /// @param transforms  all of tf that has come meanwhile.
  Findings findings(const Transforms& transforms) const;

 private:
  void checkScans(Findings& findings) const;
  void checkOwnBody(const Transforms& transforms, Findings& findings) const;
  void checkStamps(Findings& findings) const;
  void checkFrames(const Transforms& transforms, Findings& findings) const;
  void checkOdometry(Findings& findings) const;
  void checkSenders(Findings& findings) const;
  void checkMotion(const Transforms& transforms, Findings& findings) const;
  void checkMount(const Transforms& transforms, const std::vector<Pose2>& by_scans,
                  const std::vector<Pose2>& by_wheels, Findings& findings) const;

  Settings settings_;
  std::vector<sensor_msgs::LaserScan> scans_;
  std::vector<nav_msgs::Odometry> odometry_;
  std::map<std::string, std::set<std::string>> senders_;  ///< of each child: "'parent' by node"
  std::vector<double> scan_ages_, pose_ages_;             ///< s, when a scan comes
};

}  // namespace cca
