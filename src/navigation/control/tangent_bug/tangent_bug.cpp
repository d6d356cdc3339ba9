// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/tangent_bug/tangent_bug.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "geometry/cross.hpp"
#include "sensing/beam.hpp"

namespace cca {
namespace {

// m, two cells of the grid that goals come from. A boundary is left for what is nearer by as much.
constexpr double kGoalTolerance = 0.1;
constexpr double kUnsure = 0.03;    // of the distance: beams are sparse far away
constexpr double kInVain = 0.4;     // m, around a place that was promised in vain
constexpr double kLookAgain = 0.5;  // of the distance from which that was found out
// Of the margin, given up on the way, and half of it along a boundary.
constexpr double kSlack = 1.0 - RobotParameters::kLeastMargin;
constexpr double kOnTheBoundary = 0.001;  // m; rounding must not count as touching
constexpr double kLost = 1.0;             // s; noise hides a boundary for some scans
// Boundaries followed and gaps shut, without coming nearer to the goal. The proof needs fewer;
// noise and moving obstacles break it, and then this is the end.
constexpr int kMostTries = 10;
constexpr double kWaitFor = 2.5;  // m; who moves farther off is no reason to wait
constexpr double kNear = 0.15;    // m, beyond the radius: five scans of a robot at 0.3 m/s
const std::vector<Eigen::Vector2d> kDirections = directionsAround(360, 0.0);

}  // namespace

void TangentBug::setGoal(const Eigen::Vector2d& goal_map) {
  pursuit_ = {};
  pursuit_.goal_map = goal_map;
  pursuit_.has_goal = true;
  pursuit_.state = TangentBugState::kMotionToGoal;
  pursuit_.motion_to_goal.start();
  target_.reset();
}

Velocity TangentBug::step(const Scan& scan, const Pose2& T_map_robot, const Velocity& velocity,
                          double time) {
  return step({scan, T_map_robot, rangeNoise(scan).range_sigma}, velocity, time);
}

Velocity TangentBug::step(const Surroundings& surroundings, const Velocity& velocity, double time) {
  const Pose2& T_map_robot = surroundings.T_map_robot;
  observe(surroundings, time);
  target_.reset();
  time_ = time;
  const double distance = (pursuit_.goal_map - T_map_robot.position()).norm();
  if (distance < pursuit_.least_distance - kGoalTolerance) {
    pursuit_.least_distance = distance;
    pursuit_.tries = 0;
  }
  const auto isUnderWay = [this] {
    return pursuit_.state == TangentBugState::kMotionToGoal ||
           pursuit_.state == TangentBugState::kBoundaryFollowing;
  };
  if (isUnderWay() && distance <= kGoalTolerance) pursuit_.state = TangentBugState::kReached;
  // Without any valid beam the robot is blind: it stops, and what it knew stays as it was.
  if (view_.horizon > 0.0) {
    if (pursuit_.state == TangentBugState::kMotionToGoal) {
      target_ = moveToGoal();
    } else if (pursuit_.state == TangentBugState::kBoundaryFollowing) {
      target_ = followBoundary();
    }
  }
  if (isUnderWay() && pursuit_.progress.isStuck(T_map_robot.position(), pursuit_.follower.length(),
                                                time, moverIsNear())) {
    shutWhatIsTooNarrow();
  }
  std::optional<ControlTarget> target;
  if (target_) target = {*target_, *target_ == pursuit_.goal_map};
  return controller_.step(target, velocity, view_, moving_points_, robot().leastClearance(),
                          local_.way_space.radius + kNear, time);
}

bool TangentBug::moverIsNear() const {
  const Eigen::Vector2d x = view_.T_map_robot.position();
  return std::any_of(view_.movers.begin(), view_.movers.end(),
                     [&](const Eigen::Vector2d& p) { return (p - x).norm() < kWaitFor; });
}

// A gap as wide as the robot may look open from afar and shut from nearby: it is shut for good.
void TangentBug::shutWhatIsTooNarrow() {
  if (++pursuit_.tries > kMostTries) {
    pursuit_.state = TangentBugState::kUnreachable;
  } else if (pursuit_.state == TangentBugState::kBoundaryFollowing) {
    if (const auto place = pursuit_.follower.takeNarrowPlace()) pursuit_.shut_map.push_back(*place);
  } else {
    startFollowing();
  }
}

void TangentBug::observe(const Surroundings& surroundings, double time) {
  const Scan& raw_scan = surroundings.scan;
  const Eigen::Vector2d x = surroundings.T_map_robot.position();
  const double sigma = surroundings.range_sigma;
  const double radius = robot().radius + robot().safety_margin;
  const Scan smooth = smoothScan(raw_scan, sigma);
  const std::vector<bool> moving = moving_points_.update(smooth, sigma, time);
  const Scan scan = near_surfaces_.update(raw_scan, smooth, moving, sigma);
  view_ = makeLocalView(scan, moving, surroundings.T_map_robot, 2.0 * radius);
  view_.range_sigma = sigma;
  view_.obstacles.insert(view_.obstacles.end(), pursuit_.shut_map.begin(), pursuit_.shut_map.end());
  for (const Eigen::Vector2d& p_map : surroundings.known_map) {
    if (!view_.inFieldOfView(p_map)) view_.obstacles.push_back(p_map);
  }
  view_.ends_here.resize(view_.obstacles.size(), false);
  // In no order around the sensor: each is a surface of its own.
  view_.obstacles.insert(view_.obstacles.end(), surroundings.hazards_map.begin(),
                         surroundings.hazards_map.end());
  view_.ends_here.resize(view_.obstacles.size(), true);
  local_.way_space = {view_.obstacles, radius};
  // Pressed to an obstacle, the robot still sees the ways along it.
  local_.way_space.radius = std::clamp(local_.way_space.clearance(x) - kOnTheBoundary,
                                       robot().radius, radius - kSlack * robot().safety_margin);
  local_.trace_space = {view_.obstacles,
                        local_.way_space.radius + 0.5 * kSlack * robot().safety_margin};
  local_.free_ranges = local_.way_space.freeRanges(x, kDirections, view_.horizon);
  local_.nodes = localTangentGraph(view_, local_.way_space, local_.free_ranges, radius);
  findReach();
}

// d_reach: the least distance to the goal of all places in sight that the robot could drive
// straight to.
void TangentBug::findReach() {
  const Eigen::Vector2d x = view_.T_map_robot.position();
  local_.reach_map = x;
  local_.d_reach = (pursuit_.goal_map - x).norm();
  const auto consider = [&](const Eigen::Vector2d& direction, double free) {
    const double ahead = std::clamp((pursuit_.goal_map - x).dot(direction), 0.0, free);
    const Eigen::Vector2d p = x + ahead * direction;
    const double distance = (pursuit_.goal_map - p).norm();
    if (distance >= local_.d_reach || !view_.inFieldOfView(p) || isInVain(p)) return;
    local_.d_reach = distance;
    local_.reach_map = p;
  };
  for (std::size_t k = 0; k < kDirections.size(); ++k)
    consider(kDirections[k], local_.free_ranges[k].distance);
  for (const TangentNode& node : local_.nodes) {
    const double length = (node.p_map - x).norm();
    if (length > 0.0) consider((node.p_map - x) / length, length);
  }
  const double d_goal = (pursuit_.goal_map - x).norm();
  if (d_goal == 0.0) return;
  const Eigen::Vector2d towards_goal = (pursuit_.goal_map - x) / d_goal;
  consider(towards_goal,
           local_.way_space.freeDistance(x, towards_goal, std::min(d_goal, view_.horizon)));
}

// From half as far away the beams are twice as dense: then what they show counts again. The goal
// itself may lie beside a place that a door post hid from afar.
bool TangentBug::isInVain(const Eigen::Vector2d& p_map) const {
  const double distance = (p_map - view_.T_map_robot.position()).norm();
  return std::any_of(
      pursuit_.in_vain.begin(), pursuit_.in_vain.end(), [&](const Pursuit::InVain& place) {
        return (place.p_map - p_map).norm() < kInVain && distance > kLookAgain * place.distance;
      });
}

std::optional<Eigen::Vector2d> TangentBug::moveToGoal() {
  const Eigen::Vector2d x = view_.T_map_robot.position();
  pursuit_.motion_to_goal.correctPlace(x, pursuit_.goal_map, local_.way_space, local_.reach_map);
  const auto target = pursuit_.motion_to_goal.step(x, pursuit_.goal_map, local_.way_space,
                                                   local_.nodes, view_.horizon);
  if (const auto place = pursuit_.motion_to_goal.reachedInVain()) {
    pursuit_.in_vain.push_back({*place, (*place - x).norm()});
  }
  return target ? target : startFollowing();
}

std::optional<Eigen::Vector2d> TangentBug::startFollowing() {
  const Eigen::Vector2d x = view_.T_map_robot.position();
  const Eigen::Vector2d towards_goal = (pursuit_.goal_map - x).normalized();
  const double free = local_.trace_space.freeDistance(x, towards_goal, view_.horizon);
  const Eigen::Vector2d hit = x + free * towards_goal;
  // In the last direction: where the robot was heading left of the goal, it has the obstacle that
  // lies towards the goal on its right.
  const Eigen::Vector2d last =
      pursuit_.motion_to_goal.lastDirection().value_or(view_.T_map_robot.heading());
  const bool on_the_right = cross(towards_goal, last) > 0.0;
  if (!pursuit_.started_at_map ||
      (x - *pursuit_.started_at_map).norm() > BoundaryFollower::kBeside) {
    pursuit_.started_at_map = x;
    ++pursuit_.tries;
  }
  pursuit_.follower.start(hit, on_the_right, pursuit_.goal_map, view_, local_.trace_space);
  if (pursuit_.follower.trace().empty()) {  // out of sight: the boundary beside the robot then
    pursuit_.follower.start(x, on_the_right, pursuit_.goal_map, view_, local_.trace_space);
  }
  pursuit_.progress.startWalk(time_);
  pursuit_.state = TangentBugState::kBoundaryFollowing;
  return followBoundary();
}

std::optional<Eigen::Vector2d> TangentBug::followBoundary() {
  const auto target = pursuit_.follower.step(pursuit_.goal_map, view_, local_.trace_space,
                                             local_.way_space, local_.d_reach);
  const double unsure = kUnsure * (local_.reach_map - view_.T_map_robot.position()).norm();
  if (local_.d_reach < pursuit_.follower.followedDistance() - kGoalTolerance - unsure ||
      local_.d_reach < kGoalTolerance) {
    pursuit_.state = TangentBugState::kMotionToGoal;
    const double farthest =
        std::max(pursuit_.follower.followedDistance() - 0.5 * kGoalTolerance, kGoalTolerance);
    pursuit_.motion_to_goal.startFromBoundary(local_.reach_map, farthest,
                                              pursuit_.follower.onTheRight());
    return local_.reach_map;
  }
  if (pursuit_.follower.hasLooped() || pursuit_.tries > kMostTries) {
    pursuit_.state = TangentBugState::kUnreachable;
    return std::nullopt;
  }
  if (target) {
    pursuit_.lost.stop();
    return target;
  }
  // Noise hides a boundary for a moment; what moved away takes it along.
  pursuit_.lost.run(time_);
  if (pursuit_.lost.isOver(kLost, time_)) {
    pursuit_.lost.stop();
    pursuit_.state = TangentBugState::kMotionToGoal;
    pursuit_.motion_to_goal.start();
  }
  return std::nullopt;
}

}  // namespace cca
