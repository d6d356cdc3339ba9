// SPDX-License-Identifier: BSD-3-Clause
#include "goal_server.hpp"

#include <stdexcept>
#include <utility>

#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

constexpr bool kStartLater = false;
const ros::WallDuration kProgressPeriod(0.2);

}  // namespace

GoalServer::GoalServer(ros::NodeHandle& node, ros::NodeHandle& private_node, std::string map_frame,
                       Exploration& exploration)
    : map_frame_(std::move(map_frame)),
      exploration_(exploration),
      transforms_(node, [] {}),
      action_(private_node, "goal", kStartLater),
      simple_(node.subscribe("move_base_simple/goal", 1, &GoalServer::takeOfTopic, this)),
      path_(node.subscribe("patrol", 1, &GoalServer::takePatrol, this)),
      progress_(node.createWallTimer(kProgressPeriod,
                                     [this](const ros::WallTimerEvent&) { tellProgress(); })) {
  action_.registerGoalCallback([this] { takeOfAction(); });
  action_.registerPreemptCallback([this] {
    // Another goal of the action comes by takeOfAction().
    if (!action_.isNewGoalAvailable()) exploration_.recall("cancelled");
  });
  action_.start();
}

Pose2 GoalServer::inMap(const geometry_msgs::PoseStamped& goal) const {
  const Pose2 T_frame_goal = planarPose(goal.pose).pose;
  const std::string frame = frameName(goal.header.frame_id);
  if (frame.empty() || frame == frameName(map_frame_)) return T_frame_goal;
  const Transforms& tf = transforms_.transforms();
  if (!tf.has(map_frame_, frame, {})) throw std::runtime_error(tf.whyNot(map_frame_, frame));
  return tf.lookup(map_frame_, frame, {}).pose * T_frame_goal;
}

std::string GoalServer::send(const geometry_msgs::PoseStamped& goal,
                             Exploration::ErrandEnd end) try {
  const Pose2 T_map_goal = inMap(goal);
  patrol_.reset();
  exploration_.sendTo(T_map_goal, std::move(end));
  return "";
} catch (const std::runtime_error& error) {
  ROS_WARN("the goal is refused: %s", error.what());
  return error.what();
}

void GoalServer::takeOfAction() {
  const auto end = [this](auto outcome, const std::string& how) { endAction(outcome, how); };
  const std::string refused = send(action_.acceptNewGoal()->target_pose, end);
  if (!refused.empty()) action_.setAborted({}, refused);
}

void GoalServer::takeOfTopic(const geometry_msgs::PoseStamped& goal) {
  send(goal, [](auto, const std::string& how) { ROS_INFO("the goal: %s", how.c_str()); });
}

void GoalServer::takePatrol(const nav_msgs::Path& path) try {
  Patrol patrol;
  for (geometry_msgs::PoseStamped place : path.poses) {
    if (place.header.frame_id.empty()) place.header = path.header;
    patrol.places.push_back(inMap(place));
  }
  if (patrol_) exploration_.recall("the patrol is over");
  patrol_.reset();
  if (!patrol.places.empty()) patrol_ = std::move(patrol);
} catch (const std::runtime_error& error) {
  ROS_WARN("the patrol is refused: %s", error.what());
}

/// Not when the last place ends, but at the next tick: who ends it is not to be called back.
void GoalServer::goOnPatrol() {
  if (!patrol_ || !patrol_->is_due) return;
  if (patrol_->missed >= patrol_->places.size()) {
    ROS_WARN("the patrol is over: none of its places can be reached");
    return patrol_.reset();
  }
  patrol_->is_due = false;
  const std::size_t place = patrol_->next;
  patrol_->next = (place + 1) % patrol_->places.size();
  const Pose2 T_map_goal = patrol_->places[place];
  exploration_.sendTo(T_map_goal,
                      [this, place](Exploration::ErrandOutcome outcome, const std::string& how) {
                        if (outcome == Exploration::ErrandOutcome::kCalledOff) {
                          ROS_INFO("the patrol is over: %s", how.c_str());
                          return patrol_.reset();
                        }
                        const bool is_missed = outcome == Exploration::ErrandOutcome::kUnreachable;
                        if (is_missed) ROS_WARN("place %zu of the patrol: %s", place, how.c_str());
                        patrol_->missed = is_missed ? patrol_->missed + 1 : 0;
                        patrol_->is_due = true;
                      });
}

void GoalServer::endAction(Exploration::ErrandOutcome outcome, const std::string& how) {
  if (!action_.isActive()) return;
  if (outcome == Exploration::ErrandOutcome::kReached) return action_.setSucceeded({}, how);
  if (action_.isPreemptRequested()) return action_.setPreempted({}, how);
  action_.setAborted({}, how);
}

void GoalServer::tellProgress() {
  goOnPatrol();
  if (!action_.isActive()) return;
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position = poseMessage(exploration_.pose(), map_frame_, ros::Time::now());
  action_.publishFeedback(feedback);
}

}  // namespace cca
