// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/explorer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cca_mrpt/navigation/motion_control.hpp"

namespace cca {
namespace {

constexpr double kSameWayPoint = 0.1;      // m
constexpr double kHome = 0.3;              // m
constexpr double kReachedWayPoint = 0.15;  // m, a little more than Tangent Bug stops at
constexpr int kHomeNumber = -2;            // among the numbers of goals

constexpr double kAround = 0.8;        // m, of the robot: what may stand beside it
constexpr double kLookAround = 0.5;    // of the full turning rate
constexpr double kLookingTime = 30.0;  // s

GlobalPlannerParameters plannerParameters(const RobotParameters& robot,
                                          const ExplorerParameters& parameters) {
  if (parameters.path != "known_space" && parameters.path != "paper")
    throw std::runtime_error("path '" + parameters.path + "' is none of known_space, paper");
  GlobalPlannerParameters planner;
  planner.strategy = parameters.strategy;
  planner.smallest_gain = parameters.smallest_gain;
  planner.worth = planner.tour.worth = parameters.worth;
  planner.clearance = robot.leastClearance();
  return planner;
}

bool seesAllAround(const Scan& scan) {
  const double spacing = std::abs(scan.angle_increment);
  return static_cast<double>(scan.size()) * spacing > 2.0 * M_PI - 1.5 * spacing;
}

/// Of what may be in each occupied cell around a place, the point nearest to it; m, map frame.
std::vector<Eigen::Vector2d> obstaclesAround(const ExplorationGrid& grid,
                                             const Eigen::Vector2d& p_map) {
  std::vector<Eigen::Vector2d> obstacles;
  if (!grid.covers(p_map)) return obstacles;
  const double side = grid.resolution();
  const int reach = static_cast<int>(std::ceil(kAround / side));
  const Cell here = grid.cellOf(p_map);
  for (int y = here.y - reach; y <= here.y + reach; ++y) {
    for (int x = here.x - reach; x <= here.x + reach; ++x) {
      if (grid.at({x, y}) != CellState::kOccupied) continue;
      const Eigen::Vector2d centre = grid.centreOf({x, y});
      const Eigen::Vector2d half =
          Eigen::Vector2d::Constant((0.5 + ExplorationGrid::kBehindSurface) * side);
      obstacles.push_back(p_map.cwiseMax(centre - half).cwiseMin(centre + half));
    }
  }
  return obstacles;
}

/// Whether a beam goes where a place lies, however far.
bool looksTowards(const Scan& scan, const Eigen::Vector2d& p_map) {
  if (scan.size() == 0) return false;
  const Pose2& T = scan.T_map_sensor;
  const Eigen::Vector2d to = p_map - T.position();
  const double last = scan.bearing(scan.size() - 1);
  const double middle = 0.5 * (scan.angle_min + last), half = 0.5 * std::abs(last - scan.angle_min);
  const double off = wrapAngle(std::atan2(to.y(), to.x()) - T.theta - middle);
  return std::abs(off) <= half + std::abs(scan.angle_increment);
}

/// Where the robot still drives it stops first, the way that was found safe: turning would bend it.
void turnOnTheSpot(double rate, const Observation& observation, Action& action) {
  const bool drives = std::abs(observation.velocity.linear) > kStands;
  if (!drives && action.velocity.linear == 0.0) action.velocity.angular = rate;
}

/// The first way-point that is not reached yet. One that the robot stands at would hold it there:
/// Tangent Bug has arrived, and the next path may well begin with the same corner.
std::size_t nextWayPoint(const std::vector<Eigen::Vector2d>& path, const Eigen::Vector2d& robot) {
  std::size_t next = std::min<std::size_t>(1, path.size() - 1);
  while (next + 1 < path.size() && (path[next] - robot).norm() < kReachedWayPoint) ++next;
  return next;
}

}  // namespace

Explorer::Explorer(const CcaParameters& mapping, const RobotParameters& robot,
                   const ExplorerParameters& parameters)
    : parameters_(parameters),
      robot_(robot),
      mapping_(mapping),
      line_map_(mapping),
      planner_(plannerParameters(robot, parameters)),
      tangent_bug_(robot),
      progress_(robot) {}

Action Explorer::step(const Observation& observation) {
  map(observation.scan);
  return navigate(observation);
}

void Explorer::map(const Scan& scan) {
  agreement_.add(compareWithMap(scan, line_map_.walls()));
  line_map_.insert(scan);
}

void Explorer::correctMap(const PastScans& past) {
  line_map_ = LineMap(mapping_);
  for (const auto& kept : past.kept()) line_map_.insert(kept.scan);
}

void Explorer::correctNavigation(const PastScans& past) {
  planner_.correct(past);
  T_drive_map_ = T_drive_map_ * past.correctionHere().inverse();
  if (start_map_) start_map_ = past.correctionAt(*start_map_) * *start_map_;
  progress_.forgetWay();
}

Action Explorer::navigate(const Observation& observation) {
  const Eigen::Vector2d robot = observation.T_map_robot.position();
  if (!start_map_ && robot.allFinite()) start_map_ = robot;
  if (is_paused_) {
    planner_.observe(observation.scan, robot);
    progress_.excuse(observation.time);
    return {{}, {}, ExplorationStatus::kPaused, "paused"};
  }
  return is_returning_ ? goHome(observation) : explore(observation);
}

Action Explorer::explore(const Observation& observation) {
  const Plan& plan = planner_.update(observation.scan, observation.T_map_robot.position());
  if (plan.finished) {
    why_finished_ = plan.reason;
    if (parameters_.return_to_start) {
      is_returning_ = true;
      return goHome(observation);
    }
    return {{}, {}, ExplorationStatus::kFinished, plan.reason};
  }
  if (plan.look_around) return lookAround(observation);
  looks_around_since_.reset();
  if (plan.path.empty()) {
    const std::string why = plan.reason.empty() ? "waiting for a scan" : plan.reason;
    return {{}, {}, ExplorationStatus::kExploring, why};
  }
  Action action{{}, plan.path.back(), ExplorationStatus::kExploring, plan.reason};
  const std::size_t next = parameters_.path == "paper"
                               ? plan.path.size() - 1
                               : nextWayPoint(plan.path, observation.T_map_robot.position());
  const bool is_last = next + 1 == plan.path.size();
  action.velocity = driveTo(plan.path[next], observation);
  const TangentBugState state = tangent_bug_.state();
  progress_.note(planner_.goals(), plan.path, observation.time);
  const bool has_failed =
      state == TangentBugState::kUnreachable || progress_.isOverdue(observation.time);
  if (has_failed || isStuck(observation.time)) {
    const bool goes_around = planner_.goAround(progress_.shortest());
    if (has_failed && !goes_around) planner_.setGoalAside();
    if (has_failed || goes_around) way_point_.reset();
  } else if (state == TangentBugState::kReached && is_last) {
    if (looksTowards(observation.scan, plan.look_at)) {
      planner_.noteArrival();
    } else {
      const Eigen::Vector2d look_at_robot = observation.T_map_robot.inverse() * plan.look_at;
      turnOnTheSpot(velocityTowards(look_at_robot, true, robot_).angular, observation, action);
    }
  }
  return action;
}

// A disc may always turn. Should something hold it nevertheless, then not for ever.
Action Explorer::lookAround(const Observation& observation) {
  const Eigen::Vector2d robot = observation.T_map_robot.position();
  if (!looks_around_since_) looks_around_since_ = observation.time;
  if (observation.time - *looks_around_since_ > kLookingTime) planner_.noteLookAround(robot);
  Action action{{}, robot, ExplorationStatus::kExploring, planner_.plan().reason};
  action.velocity = driveTo(robot, observation);
  turnOnTheSpot(kLookAround * robot_.max_angular_velocity, observation, action);
  return action;
}

Action Explorer::goHome(const Observation& observation) {
  const Eigen::Vector2d robot = observation.T_map_robot.position();
  planner_.observe(observation.scan, robot);
  const std::string why = why_finished_.empty() ? "called back" : why_finished_;
  if ((robot - *start_map_).norm() < kHome)
    return {{}, {}, ExplorationStatus::kFinished, why + "; back at the start"};
  const auto path = planner_.pathTo(robot, *start_map_);
  progress_.note(kHomeNumber, path, observation.time);
  if (path.empty() || progress_.isOverdue(observation.time))
    return {{}, {}, ExplorationStatus::kFinished, why + "; the way back to the start is blocked"};
  Action action{{}, *start_map_, ExplorationStatus::kReturning, "back to the start"};
  const std::size_t next = nextWayPoint(path, robot);
  action.velocity = driveTo(next + 1 < path.size() ? path[next] : *start_map_, observation);
  if (progress_.isStuck(observation.time)) planner_.bar(progress_.shortest());
  return action;
}

Velocity Explorer::driveTo(const Eigen::Vector2d& way_point_map, const Observation& observation) {
  // A way-point may creep out of reach by less than what makes it another one.
  const double left = (way_point_map - observation.T_map_robot.position()).norm();
  const bool crept = tangent_bug_.state() == TangentBugState::kReached && left > kReachedWayPoint;
  const Eigen::Vector2d way_point = T_drive_map_ * way_point_map;
  if (!way_point_ || (*way_point_ - way_point).norm() > kSameWayPoint || crept) {
    tangent_bug_.setGoal(way_point);
    way_point_ = way_point;
  }
  if (!seesAllAround(observation.scan)) {
    auto obstacles = obstaclesAround(planner_.grid(), observation.T_map_robot.position());
    for (Eigen::Vector2d& p : obstacles) p = T_drive_map_ * p;
    tangent_bug_.setKnownObstacles(std::move(obstacles));
  }
  Scan scan = observation.scan;
  scan.T_map_sensor = T_drive_map_ * scan.T_map_sensor;
  return tangent_bug_.step(scan, T_drive_map_ * observation.T_map_robot, observation.velocity,
                           observation.time);
}

// By Tangent Bug alone the robot may have to drive away from its goal for long.
bool Explorer::isStuck(double time) {
  return parameters_.path == "known_space" && progress_.isStuck(time);
}

}  // namespace cca
