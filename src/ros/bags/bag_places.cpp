// SPDX-License-Identifier: BSD-3-Clause
#include "bag_places.hpp"

#include <stdexcept>
#include <utility>

#include "io/files/text.hpp"

namespace cca {

BagPlaces::BagPlaces(std::vector<Transforms::Message> messages, OdometryTrack track,
                     const LogHints& hints)
    : hints_(hints),
      messages_(std::move(messages)),
      transforms_(messages_),
      track_(std::move(track)) {
  const std::string& base = hints_.base_frame;
  if (base.empty() || transforms_.hasFrame(base)) return;
  std::string names;
  for (const auto& name : frameNames(messages_)) names += " '" + name + "'";
  throw std::runtime_error("base frame '" + base + "': tf has no such frame; it has" +
                           (names.empty() ? " none" : names));
}

void BagPlaces::take(const nav_msgs::Odometry& odometry) try {
  last_odometry_ = planarPose(odometry.pose.pose).pose;
} catch (const std::runtime_error&) {
  last_odometry_.reset();
}

const BagPlaces::Laser& BagPlaces::laserOf(const std::string& frame) {
  const auto [found, is_new] = lasers_.try_emplace(frame);
  Laser& laser = found->second;
  if (!is_new) return laser;
  const BagFrames frames =
      findFrames(messages_, frame, track_.frames(), frameName(hints_.base_frame));
  const auto knows = [&](const std::string& fixed) {
    return !fixed.empty() && transforms_.has(fixed, frames.base, ros::Time());
  };
  laser.is_fixed_map = knows(frames.map);
  if (laser.is_fixed_map) {
    laser.frames.fixed = frames.map;
    laser.frames.odom = frames.odom;
  } else if (knows(frames.odom)) {
    laser.frames.fixed = frames.odom;
  }
  laser.is_mount_told = hints_.mount || frames.mount_is_known;
  if (hints_.mount) {
    laser.frames.mount = PlanarPose{hints_.mount->T_robot_sensor, hints_.mount->upside_down};
  } else if (!frames.mount_is_known) {
    laser.frames.mount = PlanarPose{};
  }
  if (frames.base != frame || laser.frames.mount) laser.frames.base = frames.base;
  laser.frames.smooth = frames.odom;
  return laser;
}

bool BagPlaces::place(LogRecord& record, const std::string& frame, const ros::Time& time) {
  const Laser& laser = laserOf(frame);
  if (laser.frames.fixed.empty()) {
    placeByWheels(record, laser, frame, time);
    return true;
  }
  if (!hasPlacement(transforms_, laser.frames, frame, time)) {
    ++unplaced_[laser.frames.fixed];
    return false;
  }
  const ScanPlacement placement = placeByTf(record.scan, transforms_, laser.frames, frame, time);
  record.T_robot_sensor = placement.T_robot_sensor;
  record.motion = placement.motion;
  if (laser.is_fixed_map) {
    record.corrected = placement.T_fixed_robot;
    record.odometry = placement.T_odom_robot ? placement.T_odom_robot : wheelsAt(time);
  } else {
    record.odometry = placement.T_fixed_robot;
  }
  return true;
}

void BagPlaces::placeByWheels(LogRecord& record, const Laser& laser, const std::string& frame,
                              const ros::Time& time) const {
  PlanarPose mount;
  if (laser.frames.mount) {
    mount = *laser.frames.mount;
  } else if (!laser.frames.base.empty()) {
    mount = transforms_.lookup(laser.frames.base, frame, time);
  }
  record.odometry = wheelsAt(time);
  placeScan(record.scan, mount);
  record.T_robot_sensor = mount.pose;
  record.scan.T_map_sensor = record.odometry.value_or(Pose2()) * mount.pose;
}

/// Where the stamps of the odometry's messages do not reach: the last one before the scan.
std::optional<Pose2> BagPlaces::wheelsAt(const ros::Time& time) const {
  const auto between = track_.at(time);
  return between ? between : last_odometry_;
}

std::string BagPlaces::warnings() const {
  std::string text;
  for (const auto& [frame, laser] : lasers_) {
    if (laser.is_mount_told) continue;
    appendWarning("'" + frame + "' has no place on the robot ('" + laser.frames.base +
                      "') in tf, and is taken for its middle, ahead and upright (--mount tells it)",
                  text);
  }
  for (const auto& [frame, scans] : unplaced_) {
    appendWarning(
        formatted("%zu scan(s) that tf has no pose in '%s' for left out", scans, frame.c_str()),
        text);
  }
  return text;
}

}  // namespace cca
