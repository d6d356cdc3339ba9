// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/tangent_bug.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cca_mrpt/navigation/motion_control.hpp"
#include "cca_mrpt/navigation/safe_velocity.hpp"

namespace cca {
namespace {

constexpr double kGoalTolerance = 0.1;    // m
constexpr double kSlack = 0.4;            // of the margin, given up on the way
constexpr double kOnTheBoundary = 0.001;  // m
constexpr double kOtherWay = 1.0;         // m, hysteresis between the two ways around
constexpr int kBearings = 360;
constexpr double kControlPeriod = 0.1;  // s

}  // namespace

void TangentBug::setGoal(const Eigen::Vector2d& goal_map) {
  goal_map_ = goal_map;
  state_ = TangentBugState::kMotionToGoal;
  target_.reset();
  side_on_the_right_.reset();
}

Velocity TangentBug::step(const Scan& scan, const Pose2& T_map_robot, const Velocity& velocity,
                          double) {
  const double radius = robot_.radius + robot_.safety_margin;
  view_ = makeLocalView(scan, T_map_robot, 2.0 * radius);
  const Eigen::Vector2d x = T_map_robot.position();
  space_ = {view_.obstacles, radius};
  // Pressed to an obstacle, the robot still sees the ways along it.
  space_.radius = std::clamp(space_.clearance(x) - kOnTheBoundary, robot_.radius,
                             radius - kSlack * robot_.safety_margin);
  free_ranges_ = space_.freeRanges(x, kBearings, std::max(view_.horizon, 0.0));
  nodes_ = localTangentGraph(view_, space_, free_ranges_, radius);
  if ((goal_map_ - T_map_robot.position()).norm() <= kGoalTolerance) {
    state_ = TangentBugState::kReached;
  }
  target_.reset();
  if (state_ == TangentBugState::kMotionToGoal) target_ = motionToGoal();
  return drive(velocity);
}

std::optional<Eigen::Vector2d> TangentBug::motionToGoal() {
  const Eigen::Vector2d x = view_.T_map_robot.position();
  if (space_.isFree(x, goal_map_)) return goal_map_;
  const auto heuristic = [&](const TangentNode& node) {
    return (node.p_map - x).norm() + (goal_map_ - node.p_map).norm();
  };
  const TangentNode* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const TangentNode& node : nodes_) {
    // The other way around must be clearly better than what this way has promised.
    const bool other_way = side_on_the_right_ && *side_on_the_right_ != node.obstacle_on_the_right;
    const double h = heuristic(node) + (other_way ? kOtherWay : 0.0);
    if (h >= least) continue;
    least = h;
    best = &node;
  }
  if (!best) return std::nullopt;
  side_on_the_right_ = best->obstacle_on_the_right;
  return best->p_map;
}

Velocity TangentBug::drive(const Velocity& velocity) const {
  const Pose2 T_robot_map = view_.T_map_robot.inverse();
  Velocity wanted;
  if (target_) wanted = velocityTowards(T_robot_map * *target_, *target_ == goal_map_, robot_);
  if (view_.horizon == 0.0) wanted = {};
  std::vector<Hazard> hazards;
  for (const Eigen::Vector2d& p_map : view_.obstacles)
    hazards.push_back({T_robot_map * p_map, 0.0});
  return safeVelocity(wanted, velocity, hazards, robot_, robot_.radius + 0.4 * robot_.safety_margin,
                      kControlPeriod);
}

}  // namespace cca
