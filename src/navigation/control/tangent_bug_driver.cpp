// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/tangent_bug_driver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "navigation/control/motion_control.hpp"
#include "sensing/beam.hpp"

namespace cca {
namespace {

constexpr double kSameWayPoint = 0.1;      // m: below what counts as reached, see driveTo()
constexpr double kReachedWayPoint = 0.15;  // m, a little more than Tangent Bug stops at
constexpr double kAtHeading = 0.05;        // rad, of a goal's heading
constexpr double kAround = 2.0;            // m, of the robot: what a narrow laser saw before
constexpr double kPutDown = 0.5;  // m, around the start: beside the robot no laser may look

/// Of what may be in each cell beside the free ones around a place, the point nearest to it; m, map
/// frame. Cells that were never seen may hold something, too, but where the robot was put down.
std::vector<Eigen::Vector2d> obstaclesAround(const ExplorationGrid& grid,
                                             const Eigen::Vector2d& p_map,
                                             const Eigen::Vector2d& start_map) {
  std::vector<Eigen::Vector2d> obstacles;
  if (!grid.covers(p_map)) return obstacles;
  const double side = grid.resolution();
  const int reach = static_cast<int>(std::ceil(kAround / side));
  const Cell here = grid.cellOf(p_map);
  for (int y = here.y - reach; y <= here.y + reach; ++y) {
    for (int x = here.x - reach; x <= here.x + reach; ++x) {
      const Cell c{x, y};
      const CellState state = grid.at(c);
      if (isFree(state)) continue;
      const bool is_beside = std::any_of(kNeighbours.begin(), kNeighbours.begin() + 4,
                                         [&](Cell step) { return isFree(grid.at(c + step)); });
      if (!is_beside) continue;
      const Eigen::Vector2d centre = grid.centreOf(c);
      const bool was_seen = state == CellState::kOccupied;
      if (!was_seen && (centre - start_map).norm() < kPutDown) continue;
      const Eigen::Vector2d half =
          Eigen::Vector2d::Constant((0.5 + ExplorationGrid::kBehindSurface) * side);
      obstacles.push_back(p_map.cwiseMax(centre - half).cwiseMin(centre + half));
    }
  }
  return obstacles;
}

/// The first way-point that is not reached yet. One that the robot stands at would hold it there:
/// Tangent Bug has arrived, and the next path may well begin with the same corner.
std::size_t nextWayPoint(const std::vector<Eigen::Vector2d>& path, const Eigen::Vector2d& robot) {
  std::size_t next = std::min<std::size_t>(1, path.size() - 1);
  while (next + 1 < path.size() && (path[next] - robot).norm() < kReachedWayPoint) ++next;
  return next;
}

}  // namespace

Driver::Command TangentBugDriver::drive(const DriveTask& task, const Observation& seen,
                                        const WorldModel& world) {
  const Eigen::Vector2d robot_map = seen.T_map_robot.position();
  outcome_ = {task.goal};
  progress_.note(task.goal, task.path, seen.time, robot(), task.looks_around);
  Velocity velocity;
  bool is_last = true;
  if (task.has_path) {
    const std::size_t next =
        task.goes_straight ? task.path.size() - 1 : nextWayPoint(task.path, robot_map);
    is_last = next + 1 == task.path.size();
    velocity = driveTo(is_last ? task.p_map : task.path[next], task, seen, world);
  }
  outcome_.status = statusOf(task, seen, is_last, velocity);
  if (outcome_.status == GoalStatus::kUnderWay || outcome_.status == GoalStatus::kReached)
    return {velocity};
  outcome_.lost_path = progress_.shortest();
  tangent_bug_.clearGoal();
  return {velocity};
}

/// @param velocity  turned as told, where the robot is at its goal.
GoalStatus TangentBugDriver::statusOf(const DriveTask& task, const Observation& seen, bool is_last,
                                      Velocity& velocity) {
  const bool is_overdue = progress_.isOverdue(seen.time);
  if (task.looks_around) {
    turnOnTheSpot(PathProgress::kLookAround * robot().max_angular_velocity, velocity);
    return is_overdue ? GoalStatus::kGivenUp : GoalStatus::kUnderWay;
  }
  if (is_overdue) return GoalStatus::kGivenUp;
  if (!task.has_path) return GoalStatus::kUnderWay;
  if (tangent_bug_.state() == TangentBugState::kUnreachable) return GoalStatus::kUnreachable;
  if (!task.goes_straight && progress_.isStuck(seen.time, robot())) return GoalStatus::kStuck;
  const bool is_there = is_last && tangent_bug_.state() == TangentBugState::kReached;
  return is_there && turnAsTold(task, seen, velocity) ? GoalStatus::kReached
                                                      : GoalStatus::kUnderWay;
}

/// Turns as the robot is to look at its goal. @return  whether it looks so already.
bool TangentBugDriver::turnAsTold(const DriveTask& task, const Observation& seen,
                                  Velocity& velocity) const {
  const Pose2& T = seen.T_map_robot;
  Eigen::Vector2d towards = T.position();
  if (task.look_at_map) {
    if (looksTowards(seen.scan, *task.look_at_map)) return true;
    towards = *task.look_at_map;
  } else if (task.heading) {
    if (std::abs(wrapAngle(*task.heading - T.theta)) < kAtHeading) return true;
    towards += Pose2{0.0, 0.0, *task.heading}.heading();
  } else {
    return true;
  }
  turnOnTheSpot(velocityTowards(T.inverse() * towards, true, robot()).angular, velocity);
  return false;
}

// Where the robot still drives it stops first, the way that was found safe: turning would bend it.
void TangentBugDriver::turnOnTheSpot(double rate, Velocity& velocity) const {
  const CommandedMotion& motion = tangent_bug_.controller().motion();
  const bool drives = std::abs(motion.expected().velocity.linear) > kStands;
  if (!drives && velocity.linear == 0.0) velocity.angular = rate;
}

Velocity TangentBugDriver::driveTo(const Eigen::Vector2d& way_point_map, const DriveTask& task,
                                   const Observation& seen, const WorldModel& world) {
  const Eigen::Vector2d robot_map = seen.T_map_robot.position();
  // A way-point may creep out of reach by less than what makes it another one.
  const double left = (way_point_map - robot_map).norm();
  const bool crept = tangent_bug_.state() == TangentBugState::kReached && left > kReachedWayPoint;
  const Eigen::Vector2d way_point = T_drive_map_ * way_point_map;
  const auto& present = tangent_bug_.goal();
  if (!present || (*present - way_point).norm() > kSameWayPoint || crept) {
    tangent_bug_.setGoal(way_point);
  }
  TangentBug::Surroundings around{seen.scan, T_drive_map_ * seen.T_map_robot, seen.rangeSigma()};
  around.scan.T_map_sensor = T_drive_map_ * seen.scan.T_map_sensor;
  if (!seesAllAround(seen.scan)) {
    for (const Eigen::Vector2d& p_map : obstaclesAround(world.grid(), robot_map, task.start_map))
      around.known_map.push_back(T_drive_map_ * p_map);
  }
  for (const auto* points : {&seen.hazards, &seen.seen_elsewhere}) {
    for (const Eigen::Vector2d& p_map : *points) around.hazards_map.push_back(T_drive_map_ * p_map);
  }
  return tangent_bug_.step(around, seen.velocity, seen.time);
}

GoalOutcome TangentBugDriver::takeOutcome() {
  return std::exchange(outcome_, {outcome_.goal, GoalStatus::kUnderWay, {}});
}

Scan TangentBugDriver::withoutMovers(Scan scan) const {
  const Pose2 T_map_sensor = scan.T_map_sensor;
  scan.T_map_sensor = T_drive_map_ * T_map_sensor;
  scan = tangent_bug_.movers().withoutMovers(std::move(scan));
  scan.T_map_sensor = T_map_sensor;
  return scan;
}

void TangentBugDriver::pauseTimers(double time) {
  progress_.pauseTimers(time);
  tangent_bug_.pauseTimers(time);
}

void TangentBugDriver::correct(const PastScans& past) {
  T_drive_map_ = T_drive_map_ * past.correctionHere().inverse();
  progress_.correctPath();
}

}  // namespace cca
