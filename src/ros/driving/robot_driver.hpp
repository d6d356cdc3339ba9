// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "move_base_driver.hpp"
#include "ros/input/hazard_feed.hpp"
#include "ros/input/scan_feed.hpp"
#include "ros/nodes/exploration.hpp"
#include "ros/nodes/node_diagnostics.hpp"
#include "ros/nodes/node_localisation.hpp"
#include "ros/output/slam_publisher.hpp"
#include "ros/parameters/reconfigure_server.hpp"

namespace cca {

/// Explores with a robot that is out there: `scan`, tf and, where there is one, `odom` in,
/// `cmd_vel` out. It never drives blind: where no usable scan has come for `scan_timeout`
/// (for a slow laser see ScanPeriod::longestSilence()), or nobody listens to cmd_vel, the command
/// is zero, and the exploration goes on when they are back. Where move_base drives, its goal is
/// cancelled instead, and cmd_vel is not touched.
///
/// Where there are several lasers, it drives by the first one: each of its scans is a step. Those
/// of the others are mapped as they come, and what the last of each shows is no way to drive.
class RobotDriver {
 public:
  struct Settings {
    FrameNames frames;
    std::vector<std::string> scans{"scan"};   ///< topics, a laser each
    std::string hazard_points, hazard_range;  ///< topics, see HazardFeed
    double scan_timeout = 0.3;                ///< s
    std::string pose = "tf";           ///< of the robot in the map, from tf, odometry or slam
    std::string resume;                ///< folder of an earlier map, see Exploration::begin()
    std::string plan;                  ///< file of a plan in the map's frame
    std::vector<PlanLine> plan_lines;  ///< its, see Exploration::knowPlan()
    bool corrections = true;           ///< of the past where tf's map -> odom leaps
    RobotParameters robot;
    std::string driver = "cmd_vel";  ///< or move_base
  };

  static constexpr std::pair<double, double> kScanTimeouts{0.05, 5.0};  ///< s, allowed

  RobotDriver(ros::NodeHandle& node, ros::NodeHandle& private_node, const Settings& settings,
              const CcaParameters& mapping, Exploration& exploration);
  /// Leaves the robot standing.
  ~RobotDriver();
  RobotDriver(const RobotDriver&) = delete;
  RobotDriver& operator=(const RobotDriver&) = delete;

 private:
  void take(const nav_msgs::Odometry& odometry);
  void use(const PlacedScan& placed);
  void useBeside(const PlacedScan& placed);
  void addObstacles(const PlacedScan& placed, Observation& observation);
  void obey(const Velocity& velocity);
  std::vector<Eigen::Vector2d> seenElsewhere(const ros::Time& stamp,
                                             const Pose2& T_map_fixed) const;
  /// s, without a usable scan of that laser until the robot is stopped.
  double longestSilence(std::size_t topic) const;
  /// Once, where that is longer than scan_timeout.
  void tellSlowLaser(std::size_t topic);
  /// The laser that has not been heard of for too long, if any; of those from `first` on.
  std::optional<std::size_t> silentLaser(std::size_t first) const;
  void waitForLaser(std::size_t topic);
  void waitForSight(const PlacedScan& placed);
  void watch();
  /// Why the robot cannot be driven; nullptr where it can.
  const char* deaf() const;
  void stand();
  void command(const Velocity& velocity);
  Velocity measuredVelocity(const ros::Time& stamp) const;
  void checkLatency();
  void tellIfHeld(const PlacedScan& placed);
  void delegateDriving();
  std::vector<ReconfigureServer::Number> changeable();

  Settings settings_;
  Exploration& exploration_;
  ros::Publisher commands_, fixed_transforms_;
  ros::Subscriber odometry_, path_;
  std::deque<nav_msgs::Odometry> lately_;  ///< odometry
  Velocity command_;
  Pose2 T_fixed_held_;     ///< where the robot was when it last was elsewhere
  double held_for_ = 0.0;  ///< s, since then, of being told to move
  ros::Time last_stamp_;
  std::vector<ros::Time> last_used_;  ///< scan of each laser: when it came
  /// What the last scan of a laser but the first shows around the robot; m, fixed frame.
  struct Beside {
    std::vector<Eigen::Vector2d> points;
    ros::Time stamp;
  };
  std::vector<Beside> beside_;
  ros::WallTime last_moving_;
  const SlamLocaliser* slam_ = nullptr;  ///< the exploration's, with line SLAM
  std::optional<SlamPublisher> slam_publisher_;
  ExternalCorrections* external_ = nullptr;  ///< the same, with corrections of tf's
  std::optional<MoveBaseDriver> move_base_;
  HazardFeed hazards_;
  ScanFeed scans_;
  NodeDiagnostics diagnostics_;
  ReconfigureServer reconfigure_;
  ros::Timer watchdog_;
};

}  // namespace cca
