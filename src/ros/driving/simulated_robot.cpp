// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_robot.hpp"

#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>

#include "ros/messages/pose_message.hpp"
#include "ros/messages/scan_message.hpp"

namespace cca {
namespace {

constexpr double kPoseRate = 50.0;    // Hz, at least
constexpr double kLaserHeight = 0.2;  // m, for the eye only

/// What the odometry may be wrong by: the errors of its parameters, added up over the way [m] and
/// the turns [rad] so far. It is planar, so z, roll and pitch are known.
void setCovariances(const OdometryParameters& errors, double way, double turned,
                    nav_msgs::Odometry& odometry) {
  constexpr double kLeast = 1e-6;  // m^2, rad^2; nothing is known better, and 0 means: not told
  const auto square = [](double x) { return x * x; };
  auto &pose = odometry.pose.covariance, &twist = odometry.twist.covariance;
  for (std::size_t i = 0; i < 36; i += 7) pose[i] = twist[i] = kLeast;
  const double heading = square(kRadiansPerDegree * errors.drift_noise_deg) * way +
                         square(kRadiansPerDegree * errors.turn_noise_deg) * turned;
  pose[0] = pose[7] += square(errors.distance_noise) * way + heading * square(way) / 3.0;
  pose[35] += heading;
  twist[0] += square(errors.distance_noise * odometry.twist.twist.linear.x);
  twist[35] += square(kRadiansPerDegree * errors.turn_noise_deg * odometry.twist.twist.angular.z);
}

}  // namespace

SimulatedRobot::SimulatedRobot(ros::NodeHandle& node, Simulation simulation,
                               const Settings& settings)
    : simulation_(std::move(simulation)),
      frames_(settings.frames),
      has_localisation_(settings.has_localisation),
      keeps_clock_(ros::Time::isSimTime()),
      scan_period_(1.0 / settings.scan_rate),
      ticks_per_scan_(static_cast<int>(std::ceil(kPoseRate / settings.scan_rate))),
      bag_(settings.record),
      transforms_(node.advertise<tf2_msgs::TFMessage>("/tf", 100)),
      fixed_transforms_(node.advertise<tf2_msgs::TFMessage>("/tf_static", 10, true)),
      odometry_(node.advertise<nav_msgs::Odometry>("odom", 50)),
      scans_(node.advertise<sensor_msgs::LaserScan>("scan", 50)) {
  tick_ = scan_period_ / ticks_per_scan_;
  // With simulated time its source is this node: zero would mean that there is no time yet.
  start_ = keeps_clock_ ? ros::Time(1.0) : ros::Time::now();
  if (keeps_clock_) clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
  tf2_msgs::TFMessage mount;
  mount.transforms = {transformMessage({}, frames_.base, frames_.laser, now())};
  mount.transforms.back().transform.translation.z = kLaserHeight;
  fixed_transforms_.publish(mount);
  bag_.write("/tf_static", now(), mount, true);
  // The first sweep has begun before its end is now, and whoever places its beams asks for then.
  const double sweep = std::abs(simulation_.parameters().laser.sweep);
  if (sweep > 0.0) publishPose(now() - ros::Duration(sweep));
  publishPose(now());
}

void SimulatedRobot::tick(const Velocity& command) {
  simulation_.drive(command, tick_);
  turned_ += std::abs(simulation_.velocity().angular) * tick_;
  ++ticks_;
  publishPose(now());
}

void SimulatedRobot::publishPose(const ros::Time& stamp) {
  if (keeps_clock_) {
    rosgraph_msgs::Clock clock;
    clock.clock = stamp;
    clock_.publish(clock);
  }
  const Pose2 T_odom_robot = simulation_.T_odom_robot();
  tf2_msgs::TFMessage message;
  if (has_localisation_) {
    const Pose2 T_map_odom = simulation_.T_map_robot() * T_odom_robot.inverse();
    message.transforms.push_back(transformMessage(T_map_odom, frames_.map, frames_.odom, stamp));
  }
  message.transforms.push_back(transformMessage(T_odom_robot, frames_.odom, frames_.base, stamp));
  transforms_.publish(message);
  bag_.write("/tf", stamp, message);

  nav_msgs::Odometry odometry;
  odometry.header = message.transforms.back().header;
  odometry.child_frame_id = frames_.base;
  odometry.pose.pose = poseMessage(T_odom_robot);
  odometry.twist.twist.linear.x = simulation_.velocity().linear;
  odometry.twist.twist.angular.z = simulation_.velocity().angular;
  setCovariances(simulation_.parameters().odometry, simulation_.distance(), turned_, odometry);
  odometry_.publish(odometry);
  bag_.write(odometry_.getTopic(), stamp, odometry);
}

Observation SimulatedRobot::scan() {
  Observation observation = simulation_.observe();
  const LaserParameters& laser = simulation_.parameters().laser;
  const double sweep = observation.scan.sweep_duration;
  const auto header = headerMessage(frames_.laser, now() - ros::Duration(sweep));
  const LaserLimits limits{0.0, laser.range, scan_period_, sweep / std::max(1, laser.beams - 1)};
  const auto message = scanToMessage(observation.scan, limits, header);
  scans_.publish(message);
  bag_.write(scans_.getTopic(), now(), message);
  if (laser.missing != MissingReading::kTold) missing_returns_.judge(observation.scan);
  return observation;
}

}  // namespace cca
