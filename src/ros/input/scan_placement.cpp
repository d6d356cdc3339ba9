// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input/scan_placement.hpp"

#include <cmath>
#include <stdexcept>

namespace cca {
namespace {

/// s; below the first, a driver does not mean it. Lasers turn ten times a second, many of them.
constexpr double kLeastSweep = 0.01, kUsualSweep = 0.1;

SweepMotion sweepMotion(const Transforms& transforms, const PlacementFrames& frames,
                        const std::string& laser, const ros::Time& middle,
                        const ros::Duration& half) {
  const std::string& source = frames.mount ? frames.base : laser;
  const bool has_smooth = !frames.smooth.empty() && transforms.has(frames.smooth, source, middle);
  const std::string& target = has_smooth ? frames.smooth : frames.fixed;
  const auto at = [&](const ros::Time& time) -> std::optional<SensorReading> {
    if (!transforms.has(target, source, time)) return std::nullopt;
    try {
      const Pose2 pose = transforms.lookup(target, source, time).pose;
      return SensorReading{frames.mount ? pose * frames.mount->pose : pose, time.toSec()};
    } catch (const std::runtime_error&) {  // it is tilted then
      return std::nullopt;
    }
  };
  const bool has_before = middle.toSec() > half.toSec();
  return {at(middle), has_before ? at(middle - half) : std::nullopt, at(middle + half)};
}

}  // namespace

bool hasPlacement(const Transforms& transforms, const PlacementFrames& frames,
                  const std::string& laser, const ros::Time& time) {
  const bool needs_laser = frames.base.empty() || !frames.mount;
  return (!needs_laser || transforms.has(frames.fixed, laser, time)) &&
         (frames.base.empty() || transforms.has(frames.fixed, frames.base, time));
}

ScanPlacement placeByTf(Scan& scan, const Transforms& transforms, const PlacementFrames& frames,
                        const std::string& laser, const ros::Time& time) {
  ScanPlacement placement;
  PlanarPose T_fixed_sensor;
  const std::string& robot = frames.base.empty() ? laser : frames.base;
  if (frames.base.empty()) {
    T_fixed_sensor = transforms.lookup(frames.fixed, laser, time);
    placement.T_fixed_robot = T_fixed_sensor.pose;
  } else if (frames.mount) {
    const PlanarPose T_fixed_robot = transforms.lookup(frames.fixed, robot, time);
    placement.T_fixed_robot = T_fixed_robot.pose;
    placement.T_robot_sensor = frames.mount->pose;
    T_fixed_sensor = {T_fixed_robot.pose * frames.mount->pose,
                      T_fixed_robot.upside_down != frames.mount->upside_down};
  } else {
    T_fixed_sensor = transforms.lookup(frames.fixed, laser, time);
    placement.T_fixed_robot = transforms.lookup(frames.fixed, robot, time).pose;
    placement.T_robot_sensor = transforms.lookup(robot, laser, time).pose;
  }
  if (!frames.odom.empty() && transforms.has(frames.odom, robot, time)) {
    placement.T_odom_robot = transforms.lookup(frames.odom, robot, time).pose;
  }
  placeScan(scan, T_fixed_sensor);
  placement.motion = sweepMotion(transforms, frames, laser, time, halfSweep(scan.sweep_duration));
  return placement;
}

ros::Duration halfSweep(double sweep_duration) {
  const double told = std::abs(sweep_duration);
  return ros::Duration(0.5 * (told > kLeastSweep ? told : kUsualSweep));
}

}  // namespace cca
