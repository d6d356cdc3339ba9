// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/explorer.hpp"

namespace cca {
namespace {

GlobalPlannerParameters plannerParameters(const RobotParameters& robot,
                                          const ExplorerParameters& parameters) {
  GlobalPlannerParameters planner;
  planner.strategy = parameters.strategy;
  planner.clearance = robot.radius + robot.safety_margin;
  return planner;
}

constexpr double kSameWayPoint = 0.1;  // m
constexpr double kPassed = 0.25;       // m

}  // namespace

Explorer::Explorer(const CcaParameters& mapping, const RobotParameters& robot,
                   const ExplorerParameters& parameters)
    : line_map_(mapping), planner_(plannerParameters(robot, parameters)), tangent_bug_(robot) {}

Action Explorer::step(const Observation& observation) {
  line_map_.insert(observation.scan);
  const Plan& plan = planner_.update(observation.scan, observation.T_map_robot.position());
  Action action;
  action.reason = plan.reason;
  if (plan.finished) {
    action.status = ExplorationStatus::kFinished;
    return action;
  }
  action.goal = plan.path.back();
  action.velocity = follow(plan, observation);
  return action;
}

// Way-points are the corners of the path; the next one counts as soon as the last is passed.
Velocity Explorer::follow(const Plan& plan, const Observation& observation) {
  const Eigen::Vector2d robot = observation.T_map_robot.position();
  std::size_t next = plan.path.size() > 1 ? 1 : 0;
  for (std::size_t i = next; i + 1 < plan.path.size(); ++i) {
    if ((plan.path[i] - robot).norm() < kPassed) next = i + 1;
  }
  const Eigen::Vector2d way_point = plan.path[next];
  if (!way_point_ || (*way_point_ - way_point).norm() > kSameWayPoint) {
    tangent_bug_.setGoal(way_point);
    way_point_ = way_point;
  }
  const Velocity velocity = tangent_bug_.step(observation.scan, observation.T_map_robot,
                                              observation.velocity, observation.time);
  if (tangent_bug_.state() == TangentBugState::kUnreachable) {
    planner_.setGoalAside();
    way_point_.reset();
  }
  return velocity;
}

}  // namespace cca
