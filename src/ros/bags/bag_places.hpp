// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bag_frames.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "ros/input/odometry_track.hpp"
#include "ros/input/scan_placement.hpp"

namespace cca {

/// Puts the scans of a bag where its robot was: by tf, else by its odometry's messages.
class BagPlaces {
 public:
  /// @param messages  all of the bag's tf.
  /// @throws std::runtime_error where the hints name a frame that tf does not have.
  BagPlaces(std::vector<Transforms::Message> messages, OdometryTrack track, const LogHints& hints);

  /// Odometry as it comes between the scans.
  void take(const nav_msgs::Odometry& odometry);

  /// Gives the record its poses. tf may end before the scans, or begin after them: where it knows a
  /// pose of the robot at some time, a scan is not put into another frame instead.
  /// @param laser  frame of the scan. @param time  of the poses.
  /// @return  whether its place is known; else it is counted.
  /// @throws std::runtime_error as placeByTf() does.
  bool place(LogRecord& record, const std::string& laser, const ros::Time& time);

  /// What had to be assumed, and what was missed, for people; empty where all was well.
  std::string warnings() const;

 private:
  /// What the scans of one laser are placed by.
  struct Laser {
    PlacementFrames frames;      ///< fixed: empty where tf tells no pose of the robot
    bool is_fixed_map = false;   ///< else it is the odometry's frame
    bool is_mount_told = false;  ///< by tf, or as a hint
  };

  const Laser& laserOf(const std::string& frame);
  void placeByWheels(LogRecord& record, const Laser& laser, const std::string& frame,
                     const ros::Time& time) const;
  std::optional<Pose2> wheelsAt(const ros::Time& time) const;

  LogHints hints_;
  std::vector<Transforms::Message> messages_;
  Transforms transforms_;
  OdometryTrack track_;
  std::optional<Pose2> last_odometry_;
  std::map<std::string, Laser> lasers_;          ///< by their frames
  std::map<std::string, std::size_t> unplaced_;  ///< scans by the frame that they have no pose in
};

}  // namespace cca
