// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/explorer.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/navigation/drive/motion_control.hpp"
#include "cca_mrpt/sensing/beam.hpp"

namespace cca {
namespace {

constexpr double kSameWayPoint = 0.1;              // m
constexpr double kHome = 0.3;                      // m
constexpr double kReachedWayPoint = 0.15;          // m, a little more than Tangent Bug stops at
constexpr int kHomeNumber = -2, kTurnNumber = -3;  // among the numbers of goals
constexpr int kErrandNumber = -4;                  // of the first errand; the next ones lie below

constexpr double kAtHeading = 0.05;  // rad, of the goal that it was sent to
constexpr double kWayLost = 10.0;    // s; who stands in the only way for a moment may leave
constexpr int kMostHeld = 2;

constexpr double kAround = 2.0;      // m, of the robot: what a narrow laser saw before
constexpr double kPutDown = 0.5;     // m, around the start: beside the robot no laser may look
constexpr double kLookAround = 0.5;  // of the full turning rate
constexpr double kTurn = 2.0 / 3.0 * M_PI;  // rad: three make one round, and none is ambiguous

constexpr double kMuchUnreached = 1.0;  // m^2
constexpr double kMuchOfAll = 0.05;

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

using Way = std::vector<Eigen::Vector2d>;

/// The first way-point that is not reached yet. One that the robot stands at would hold it there:
/// Tangent Bug has arrived, and the next path may well begin with the same corner.
std::size_t nextWayPoint(const std::vector<Eigen::Vector2d>& path, const Eigen::Vector2d& robot) {
  std::size_t next = std::min<std::size_t>(1, path.size() - 1);
  while (next + 1 < path.size() && (path[next] - robot).norm() < kReachedWayPoint) ++next;
  return next;
}

}  // namespace

const char* nameOf(ExplorationStatus status) {
  constexpr const char* kNames[] = {"exploring", "returning", "paused",     "finished",
                                    "driving",   "arrived",   "unreachable"};
  return kNames[static_cast<int>(status)];
}

Explorer::Explorer(const RobotParameters& robot, const ExplorerParameters& parameters)
    : parameters_(parameters),
      robot_(robot),
      planner_(parameters, robot.leastClearance(), robot.radius),
      tangent_bug_(robot),
      progress_(robot) {}

void Explorer::observe(const Scan& scan, const Pose2& T_map_robot) {
  planner_.place().observe(scan, T_map_robot.position());
}

void Explorer::correct(const PastScans& past) {
  planner_.correct(past);
  T_drive_map_ = T_drive_map_ * past.correctionHere().inverse();
  if (T_map_start_) T_map_start_ = past.correctionAt(T_map_start_->position()) * *T_map_start_;
  if (errand_) {
    errand_->T_map_goal = past.correctionAt(errand_->T_map_goal.position()) * errand_->T_map_goal;
  }
  T_map_turned_.reset();
  progress_.correctWay();
}

void Explorer::changeMotion(const RobotParameters& robot) {
  robot_ = robot_.movingAs(robot);
  progress_.changeMotion(robot_);
  tangent_bug_.changeMotion(robot_);
}

Action Explorer::step(const Observation& observation) {
  Action action = decide(observation);
  outcome_.reset();
  // What others command is not known, nor what it would show of the base.
  if (!leaves_driving_) {
    tangent_bug_.noteSent(action.velocity, observation.velocity, observation.time);
  }
  return action;
}

void Explorer::excuse(double time) {
  progress_.excuse(time);
  tangent_bug_.excuse(time);
}

Action Explorer::decide(const Observation& observation) {
  const Eigen::Vector2d robot = observation.T_map_robot.position();
  if (!isFinite(observation.T_map_robot) || !isFinite(observation.scan.T_map_sensor)) {
    excuse(observation.time);
    return {{}, {}, ExplorationStatus::kExploring, "waiting for a pose that is a number"};
  }
  if (!T_map_start_) T_map_start_ = observation.T_map_robot;
  if (observation.is_localised && !observation.hazards.empty()) {
    planner_.place().heed(observation.hazards);
  }
  if (errand_) return runErrand(observation);
  if (is_paused_) {
    if (observation.is_localised) planner_.place().observe(observation.scan, robot);
    excuse(observation.time);
    return {{}, {}, ExplorationStatus::kPaused, "paused"};
  }
  if (leaves_driving_ && !observation.is_localised) {
    excuse(observation.time);
    return {{}, {}, ExplorationStatus::kExploring, "waiting until the pose is known again"};
  }
  if (is_returning_ != was_returning_) outcome_.reset();  // that of another goal
  was_returning_ = is_returning_;
  return is_returning_ ? goHome(observation) : explore(observation);
}

Action Explorer::explore(const Observation& observation) {
  heedOutcome(observation.T_map_robot.position());
  const Plan& plan = planner_.update(observation.scan, observation.T_map_robot.position(),
                                     observation.is_localised);
  if (plan.isFinished()) {
    why_finished_ = plan.reason;
    if (parameters_.return_to_start) {
      is_returning_ = was_returning_ = true;
      return goHome(observation);
    }
    return {{}, {}, ExplorationStatus::kFinished, plan.reason};
  }
  if (plan.phase == PlanPhase::kLookingAround) return lookAround(observation);
  T_map_turned_.reset();
  if (plan.phase == PlanPhase::kUndecided) {
    const std::string why = plan.reason.empty() ? "waiting for a scan" : plan.reason;
    return {{}, {}, ExplorationStatus::kExploring, why};
  }
  Action action{{}, plan.path.back(), ExplorationStatus::kExploring, plan.reason};
  progress_.note(planner_.goals(), plan.path, observation.time);
  const bool is_overdue = progress_.isOverdue(observation.time);
  // Others have ways of their own: that ours does not become shorter says nothing.
  if (leaves_driving_) {
    const Eigen::Vector2d ahead = plan.look_at - *action.goal;
    action.goal_heading = std::atan2(ahead.y(), ahead.x());
    if (is_overdue) planner_.setGoalAside();
    return action;
  }
  // By Tangent Bug alone the robot may have to drive away from its goal for long.
  const bool goes_straight = parameters_.path == PathKind::kPaper;
  const std::size_t next = goes_straight
                               ? plan.path.size() - 1
                               : nextWayPoint(plan.path, observation.T_map_robot.position());
  const bool is_last = next + 1 == plan.path.size();
  action.velocity = driveTo(plan.path[next], observation);
  const TangentBugState state = tangent_bug_.state();
  const bool has_failed = state == TangentBugState::kUnreachable || is_overdue;
  if (has_failed || (!goes_straight && progress_.isStuck(observation.time))) {
    planner_.leaveWay(progress_.shortest(), has_failed);
    way_point_.reset();
  } else if (state == TangentBugState::kReached && is_last) {
    if (looksTowards(observation.scan, plan.look_at)) {
      planner_.noteArrival();
    } else {
      turnTowards(plan.look_at, observation.T_map_robot, action);
    }
  }
  return action;
}

// The goal of the last action is the planner's still: it decides in its updates only.
void Explorer::heedOutcome(const Eigen::Vector2d& robot_map) {
  if (!outcome_) return;
  const bool has_failed = *outcome_ == DriveOutcome::kFailed;
  outcome_.reset();
  if (T_map_turned_) {
    T_map_turned_->theta = wrapAngle(T_map_turned_->theta + kTurn);
    if (has_failed) planner_.noteLookAround(robot_map);  // it sees no more from here
  } else if (has_failed) {
    planner_.setGoalAside();
  } else {
    planner_.noteArrival();
  }
}

void Explorer::turnTowards(const Eigen::Vector2d& p_map, const Pose2& T_map_robot,
                           Action& action) const {
  turnOnTheSpot(velocityTowards(T_map_robot.inverse() * p_map, true, robot_).angular, action);
}

// Where the robot still drives it stops first, the way that was found safe: turning would bend it.
void Explorer::turnOnTheSpot(double rate, Action& action) const {
  const bool drives = std::abs(tangent_bug_.motion().expected().velocity.linear) > kStands;
  if (!drives && action.velocity.linear == 0.0) action.velocity.angular = rate;
}

// A disc may always turn. Should something hold it nevertheless, then not for ever.
Action Explorer::lookAround(const Observation& observation) {
  const Pose2& T = observation.T_map_robot;
  const double turn = 2.0 * M_PI / (kLookAround * robot_.max_angular_velocity);
  progress_.note(kTurnNumber, {T.position()}, observation.time, turn);
  if (progress_.isOverdue(observation.time)) planner_.noteLookAround(T.position());
  Action action{{}, T.position(), ExplorationStatus::kExploring, planner_.plan().reason};
  if (leaves_driving_) {
    if (!T_map_turned_) T_map_turned_ = Pose2{T.x, T.y, wrapAngle(T.theta + kTurn)};
    action.goal = T_map_turned_->position();
    action.goal_heading = T_map_turned_->theta;
  } else {
    action.velocity = driveTo(T.position(), observation);
    turnOnTheSpot(kLookAround * robot_.max_angular_velocity, action);
  }
  return action;
}

Action Explorer::goHome(const Observation& observation) {
  const Eigen::Vector2d robot = observation.T_map_robot.position(),
                        start = T_map_start_->position();
  if (observation.is_localised) planner_.place().observe(observation.scan, robot);
  const std::string why = why_finished_.empty() ? "called back" : why_finished_;
  const bool is_back = leaves_driving_ && outcome_ == DriveOutcome::kReached;
  if ((robot - start).norm() < kHome || is_back)
    return {{}, {}, ExplorationStatus::kFinished, why + "; back at the start"};
  const auto path = planner_.pathTo(robot, start);
  // Who stands in the way for a moment may leave: a place that there is no way from has time, too.
  progress_.note(kHomeNumber, path.empty() ? Way{robot, start} : path, observation.time);
  if (progress_.isOverdue(observation.time) || outcome_ == DriveOutcome::kFailed)
    return {{}, {}, ExplorationStatus::kFinished, why + "; the way back to the start is blocked"};
  Action action{{}, start, ExplorationStatus::kReturning, "back to the start", T_map_start_->theta};
  if (leaves_driving_ || path.empty()) return action;
  followWay(path, start, observation, action);
  return action;
}

/// Along a known way to a place. Where the robot gets no farther, the way is barred.
void Explorer::followWay(const Way& way, const Eigen::Vector2d& end, const Observation& observation,
                         Action& action) {
  const std::size_t next = nextWayPoint(way, observation.T_map_robot.position());
  action.velocity = driveTo(next + 1 < way.size() ? way[next] : end, observation);
  const bool is_held =
      tangent_bug_.state() == TangentBugState::kUnreachable || progress_.isStuck(observation.time);
  if (!is_held) return;
  planner_.place().bar(progress_.shortest());
  way_point_.reset();
  if (errand_) ++errand_->held;
}

void Explorer::sendTo(const Pose2& T_map_goal) {
  errand_ = Errand{T_map_goal, {}};
  ++errands_;
}

Action Explorer::runErrand(const Observation& observation) {
  const Pose2& T = observation.T_map_robot;
  Action action{{},
                errand_->T_map_goal.position(),
                ExplorationStatus::kSent,
                "to where it was sent",
                errand_->T_map_goal.theta};
  if (!observation.is_localised) {
    excuse(observation.time);
    action.reason = "waiting until the pose is known again";
    return action;
  }
  planner_.place().observe(observation.scan, T.position());
  const Way way = planner_.pathTo(T.position(), *action.goal);
  const bool leads_there = !way.empty() && (way.back() - *action.goal).norm() < kBesideGoal;
  progress_.note(kErrandNumber - errands_, leads_there ? way : Way{T.position(), *action.goal},
                 observation.time);
  if (!leads_there) {
    errand_->without_way.run(observation.time);
    if (errand_->without_way.isOver(kWayLost, observation.time))
      return endErrand(ExplorationStatus::kUnreachable, "no known way leads there");
    action.reason = "waiting for a way to where it was sent";
    return action;
  }
  errand_->without_way.stop();
  followWay(way, way.back(), observation, action);
  if (errand_->held >= kMostHeld || progress_.isOverdue(observation.time))
    return endErrand(ExplorationStatus::kUnreachable, "the robot does not get there");
  const bool is_there = (way.back() - T.position()).norm() < kReachedWayPoint;
  if (!is_there || tangent_bug_.state() != TangentBugState::kReached) return action;
  const double off = wrapAngle(action.goal_heading - T.theta);
  if (std::abs(off) < kAtHeading) return endErrand(ExplorationStatus::kArrived, "there");
  turnTowards(T.position() + Pose2{0.0, 0.0, action.goal_heading}.heading(), T, action);
  return action;
}

Action Explorer::endErrand(ExplorationStatus status, const std::string& reason) {
  errand_.reset();
  way_point_.reset();
  return {{}, {}, status, reason};
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
    auto obstacles = obstaclesAround(planner_.place().grid(), observation.T_map_robot.position(),
                                     T_map_start_->position());
    for (Eigen::Vector2d& p : obstacles) p = T_drive_map_ * p;
    tangent_bug_.setKnownObstacles(std::move(obstacles));
  }
  std::vector<Eigen::Vector2d> hazards;
  for (const auto* points : {&observation.hazards, &observation.seen_elsewhere}) {
    for (const Eigen::Vector2d& p_map : *points) hazards.push_back(T_drive_map_ * p_map);
  }
  tangent_bug_.setHazards(std::move(hazards));
  Scan scan = observation.scan;
  scan.T_map_sensor = T_drive_map_ * scan.T_map_sensor;
  return tangent_bug_.step(scan, T_drive_map_ * observation.T_map_robot, observation.velocity,
                           observation.time);
}

bool Explorer::leavesMuch() const {
  const double side = grid().resolution();
  const double seen = static_cast<double>(grid().revealed()) * side * side;
  return planner_.plan().isFinished() &&
         planner_.plan().passableArea() > std::max(kMuchUnreached, kMuchOfAll * seen);
}

}  // namespace cca
