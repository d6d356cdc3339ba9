// SPDX-License-Identifier: BSD-3-Clause
#include "move_base_driver.hpp"

#include <ros/ros.h>

#include <cmath>
#include <utility>

#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

// Goals move by so little where the map is corrected: less than navigations stop at.
constexpr double kSamePlace = 0.05;   // m
constexpr double kSameHeading = 0.1;  // rad
constexpr bool kOwnThread = false;    // callbacks come with all others, by keepRunning()

bool isSameGoal(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm() < kSamePlace &&
         std::abs(wrapAngle(a.theta - b.theta)) < kSameHeading;
}

}  // namespace

MoveBaseDriver::MoveBaseDriver(std::string map_frame, std::function<void(DriveOutcome)> outcome,
                               std::function<void()> taken)
    : map_frame_(std::move(map_frame)),
      outcome_(std::move(outcome)),
      taken_(std::move(taken)),
      client_("move_base", kOwnThread) {}

void MoveBaseDriver::driveTo(const Pose2& T_map_goal) {
  if (T_map_goal_ && isSameGoal(*T_map_goal_, T_map_goal)) return;
  T_map_goal_ = T_map_goal;
  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose.header.frame_id = map_frame_;
  goal.target_pose.header.stamp = ros::Time::now();
  goal.target_pose.pose = poseMessage(T_map_goal);
  client_.sendGoal(
      goal, [this](const actionlib::SimpleClientGoalState& state,
                   const move_base_msgs::MoveBaseResultConstPtr& /*result*/) { onDone(state); });
}

void MoveBaseDriver::stop() {
  if (!T_map_goal_) return;
  T_map_goal_.reset();
  client_.cancelGoal();
  client_.stopTrackingGoal();
}

void MoveBaseDriver::forget() {
  if (!T_map_goal_) return;
  T_map_goal_.reset();
  client_.stopTrackingGoal();
}

// Those that were cancelled or replaced are tracked no longer.
void MoveBaseDriver::onDone(const actionlib::SimpleClientGoalState& state) {
  T_map_goal_.reset();
  switch (state.state_) {
    case actionlib::SimpleClientGoalState::SUCCEEDED:
      return outcome_(DriveOutcome::kReached);
    case actionlib::SimpleClientGoalState::ABORTED:
    case actionlib::SimpleClientGoalState::REJECTED:
      ROS_WARN("move_base: %s: %s; the goal is set aside", state.toString().c_str(),
               state.getText().c_str());
      return outcome_(DriveOutcome::kFailed);
    case actionlib::SimpleClientGoalState::PREEMPTED:
    case actionlib::SimpleClientGoalState::RECALLED:
      return taken_();
    default:  // lost: move_base was started anew, and is sent there again
      return;
  }
}

}  // namespace cca
