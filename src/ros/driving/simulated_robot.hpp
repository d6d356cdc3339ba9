// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <string>

#include "cca_mrpt/sensing/missing_returns.hpp"
#include "cca_mrpt/simulation/simulation.hpp"
#include "ros/bags/bag_recorder.hpp"
#include "ros/input/transforms.hpp"
#include "sensing/motion_compensation.hpp"

namespace cca {

/// A Simulation as a robot of ROS: `scan`, `odom`, tf map->odom (of a perfect localisation, where
/// there is one), odom->base_link and base_link->laser, and `/clock` where the nodes use simulated
/// time. No other node may publish these transforms.
class SimulatedRobot {
 public:
  struct Settings {
    FrameNames frames;
    double scan_rate = 10.0;       ///< Hz, positive. Poses are told at least 50 times a second.
    std::string record;            ///< bag for scan, odom and tf; empty: none
    bool has_localisation = true;  ///< false: nobody here tells map->odom
  };
  SimulatedRobot(ros::NodeHandle& node, Simulation simulation, const Settings& settings);

  /// Drives for one tick towards the command, then tells the time and where the robot is.
  void tick(const Velocity& command);
  /// s, what a tick takes.
  double tickPeriod() const { return tick_; }
  bool scanIsDue() const { return ticks_ % ticks_per_scan_ == 0; }
  /// Takes a scan whose sweep ends now, and publishes it after the transforms that place it.
  /// @return  it as a robot uses it: a real laser's judged and brought to one instant.
  Observation scan();

  /// The present moment: from 1 s on with simulated time, else that of the wall's clock at the
  /// start and on from there.
  ros::Time now() const { return start_ + ros::Duration(simulation_.time()); }
  /// Keeps the stamps with the wall's clock after the simulation was late (see Pace::forgive).
  void skip(double seconds) {
    if (!keeps_clock_) start_ += ros::Duration(seconds);
  }
  const Simulation& simulation() const { return simulation_; }

 private:
  void publishPose(const ros::Time& stamp);

  Simulation simulation_;
  MissingReturns missing_returns_;
  FrameNames frames_;
  bool has_localisation_;
  ros::Time start_;
  bool keeps_clock_;
  double scan_period_, tick_;
  int ticks_per_scan_;
  long ticks_ = 0;
  double turned_ = 0.0;  ///< rad
  BagRecorder bag_;
  ros::Publisher clock_, transforms_, fixed_transforms_, odometry_, scans_;
};

}  // namespace cca
