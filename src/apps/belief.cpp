// SPDX-License-Identifier: BSD-3-Clause
#include "belief.hpp"

#include "cca_mrpt/io/memory_file.hpp"
#include "on_all_cores.hpp"

namespace cca::apps {

Belief::Belief(const Parameters& parameters, const Pose2& T_map_start)
    : source_(parameters.run.pose) {
  if (source_ == "icp") icp_.emplace(T_map_start, parameters.icp);
  if (source_ == "slam") slam_.emplace(T_map_start);
}

void Belief::remember(const SlamMemory& memory) {
  slam_->remember(memory);
  cca::remember(memory, past_);
}

bool Belief::replacePose(Observation& observation, const Pose2& T_odom_robot) {
  const Pose2 T_robot_sensor = observation.T_map_robot.inverse() * observation.scan.T_map_sensor;
  bool is_corrected = false;
  if (slam_) {
    const SlamPose pose = slam_->step(observation.scan, T_robot_sensor, T_odom_robot);
    observation.T_map_robot = pose.T_map_robot;
    observation.is_placed = !pose.is_lost;
    is_corrected = pose.version != version_;
    if (is_corrected) correctPast();
  } else if (icp_) {
    observation.T_map_robot = icp_->locate(observation.scan, T_robot_sensor, T_odom_robot);
  } else if (source_ == "odometry") {
    observation.T_map_robot = T_odom_robot;  // the frames of map and odometry begin as one
  }
  observation.scan.T_map_sensor = observation.T_map_robot * T_robot_sensor;
  if (!is_corrected) trajectory_.push_back(observation.T_map_robot);
  if (slam_) past_.add(observation.scan, observation.T_map_robot, observation.is_placed);
  return is_corrected;
}

bool Belief::finish() {
  if (!slam_) return false;
  slam_->finish(doOnAllCores);
  correctPast();
  return true;
}

void Belief::correctPast() {
  version_ = slam_->version();
  const std::vector<Pose2> poses = slam_->trajectory();
  past_.correct(poses, slam_->isPlaced());
  trajectory_.assign(poses.begin() + slam_->remembered(), poses.end());
}

}  // namespace cca::apps
