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
/// A goal that does not please is one thing; a move_base that takes none is not ready, or not one.
constexpr int kMostRejected = 5;
constexpr bool kOwnThread = false;  // callbacks come with all others, by keepRunning()

bool isSameGoal(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm() < kSamePlace &&
         std::abs(wrapAngle(a.theta - b.theta)) < kSameHeading;
}

}  // namespace

MoveBaseDriver::MoveBaseDriver(std::string map_frame, std::function<void(DriveOutcome)> outcome,
                               std::function<void(const std::string&)> barred)
    : map_frame_(std::move(map_frame)),
      outcome_(std::move(outcome)),
      barred_(std::move(barred)),
      client_("move_base", kOwnThread) {}

void MoveBaseDriver::driveTo(const Pose2& T_map_goal) {
  if (T_map_goal_ && isSameGoal(*T_map_goal_, T_map_goal)) return;
  T_map_goal_ = T_map_goal;
  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose = poseMessage(T_map_goal, map_frame_, ros::Time::now());
  client_.sendGoal(
      goal, [this](const actionlib::SimpleClientGoalState& state,
                   const move_base_msgs::MoveBaseResultConstPtr& /*result*/) { onDone(state); });
}

void MoveBaseDriver::stop() {
  if (T_map_goal_) client_.cancelGoal();
  forget();
}

void MoveBaseDriver::forget() {
  if (!T_map_goal_) return;
  T_map_goal_.reset();
  client_.stopTrackingGoal();
}

// Those that were cancelled or replaced are tracked no longer.
void MoveBaseDriver::onDone(const actionlib::SimpleClientGoalState& state) {
  T_map_goal_.reset();
  if (state.state_ != actionlib::SimpleClientGoalState::REJECTED) rejected_ = 0;
  const std::string why = state.getText();
  switch (state.state_) {
    case actionlib::SimpleClientGoalState::SUCCEEDED:
      return outcome_(DriveOutcome::kReached);
    case actionlib::SimpleClientGoalState::REJECTED:
      ROS_WARN("move_base: REJECTED: %s; the goal is set aside", why.c_str());
      if (++rejected_ < kMostRejected) return outcome_(DriveOutcome::kFailed);
      rejected_ = 0;
      return barred_("move_base rejects one goal after another" + (why.empty() ? "" : ": " + why));
    case actionlib::SimpleClientGoalState::ABORTED:
      ROS_WARN("move_base: %s: %s; the goal is set aside", state.toString().c_str(), why.c_str());
      return outcome_(DriveOutcome::kFailed);
    case actionlib::SimpleClientGoalState::PREEMPTED:
    case actionlib::SimpleClientGoalState::RECALLED:
      return barred_("somebody else has sent move_base elsewhere");
    default:  // lost: move_base was started anew, and is sent there again
      ROS_WARN_THROTTLE(5.0, "move_base: %s: it has dropped the goal, and is sent it again",
                        state.toString().c_str());
  }
}

}  // namespace cca
