// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/tangent_bug/tangent_bug.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cca_mrpt/geometry/cross.hpp"
#include "cca_mrpt/sensing/beam.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca {
namespace {

constexpr double kGoalTolerance = 0.1;  // m, two cells of the grid that goals come from
constexpr double kAtTheGoal = 0.07;     // m, worth leaving any boundary
constexpr double kLeave = 0.1;          // m, by which d_reach must be below d_followed
constexpr double kUnsure = 0.03;        // of the distance: beams are sparse far away
constexpr double kInVain = 0.4;         // m, around a place that was promised in vain
constexpr double kLookAgain = 0.5;      // of the distance from which that was found out
// Of the margin, given up on the way.
constexpr double kSlack = 1.0 - RobotParameters::kLeastMargin;
constexpr double kTraceSlack = 0.3;       // of the margin, given up along a boundary
constexpr double kOnTheBoundary = 0.001;  // m; rounding must not count as touching
constexpr double kSameArea = 1.0;         // m; from farther off another boundary may be near
constexpr double kLost = 1.0;             // s; noise hides a boundary for some scans
// Boundaries followed and gaps shut, without coming nearer to the goal. The proof needs fewer;
// noise and moving obstacles break it, and then this is the end.
constexpr int kMostTries = 10;
constexpr double kWaitFor = 2.5;  // m; who moves farther off is no reason to wait
constexpr double kNear = 0.15;    // m, beyond the radius
const std::vector<Eigen::Vector2d> kDirections = directionsAround(360, 0.0);

}  // namespace

void TangentBug::setGoal(const Eigen::Vector2d& goal_map) {
  goal_map_ = goal_map;
  state_ = TangentBugState::kMotionToGoal;
  target_.reset();
  motion_to_goal_.start();
  in_vain_.clear();
  shut_map_.clear();
  started_at_map_.reset();
  lost_.stop();
  tries_ = 0;
  least_distance_ = std::numeric_limits<double>::infinity();
  progress_ = {};
}

Velocity TangentBug::step(const Scan& scan, const Pose2& T_map_robot, const Velocity& velocity,
                          double time) {
  observe(scan, T_map_robot, time);
  target_.reset();
  time_ = time;
  const double distance = (goal_map_ - T_map_robot.position()).norm();
  if (distance < least_distance_ - kLeave) {
    least_distance_ = distance;
    tries_ = 0;
  }
  const auto isUnderWay = [this] {
    return state_ == TangentBugState::kMotionToGoal ||
           state_ == TangentBugState::kBoundaryFollowing;
  };
  if (isUnderWay() && distance <= kGoalTolerance) state_ = TangentBugState::kReached;
  // Without any valid beam the robot is blind: it stops, and what it knew stays as it was.
  if (view_.horizon > 0.0) {
    if (state_ == TangentBugState::kMotionToGoal) {
      target_ = moveToGoal();
    } else if (state_ == TangentBugState::kBoundaryFollowing) {
      target_ = followBoundary();
    }
  }
  if (isUnderWay() &&
      progress_.isStuck(T_map_robot.position(), follower_.length(), time, moverIsNear())) {
    shutWhatIsTooNarrow();
  }
  std::optional<DriveTarget> target;
  if (target_) target = {*target_, *target_ == goal_map_};
  return driver_.step(target, velocity, view_, moving_points_, robot_.leastClearance(),
                      way_space_.radius + kNear, time);
}

bool TangentBug::moverIsNear() const {
  const Eigen::Vector2d x = view_.T_map_robot.position();
  return std::any_of(view_.movers.begin(), view_.movers.end(),
                     [&](const Eigen::Vector2d& p) { return (p - x).norm() < kWaitFor; });
}

// A gap as wide as the robot may look open from afar and shut from nearby: it is shut for good.
void TangentBug::shutWhatIsTooNarrow() {
  if (++tries_ > kMostTries) {
    state_ = TangentBugState::kUnreachable;
  } else if (state_ == TangentBugState::kBoundaryFollowing) {
    if (const auto place = follower_.takeNarrowPlace()) shut_map_.push_back(*place);
  } else {
    startFollowing();
  }
}

void TangentBug::observe(const Scan& raw_scan, const Pose2& T_map_robot, double time) {
  const Eigen::Vector2d x = T_map_robot.position();
  const double sigma = rangeNoise(raw_scan).range_sigma;
  const double radius = robot_.radius + robot_.safety_margin;
  const Scan smooth = smoothScan(raw_scan, sigma);
  const std::vector<bool> moving = moving_points_.update(smooth, sigma, time);
  const Scan scan = near_surfaces_.update(raw_scan, smooth, moving, sigma);
  view_ = makeLocalView(scan, moving, T_map_robot, 2.0 * radius);
  view_.range_sigma = sigma;
  view_.obstacles.insert(view_.obstacles.end(), shut_map_.begin(), shut_map_.end());
  for (const Eigen::Vector2d& p_map : known_map_) {
    if (!view_.inFieldOfView(p_map)) view_.obstacles.push_back(p_map);
  }
  view_.ends_here.resize(view_.obstacles.size(), false);
  // In no order around the sensor: each is a surface of its own.
  view_.obstacles.insert(view_.obstacles.end(), hazards_map_.begin(), hazards_map_.end());
  view_.ends_here.resize(view_.obstacles.size(), true);
  way_space_ = {view_.obstacles, radius};
  // Pressed to an obstacle, the robot still sees the ways along it.
  way_space_.radius = std::clamp(way_space_.clearance(x) - kOnTheBoundary, robot_.radius,
                                 radius - kSlack * robot_.safety_margin);
  trace_space_ = {view_.obstacles,
                  way_space_.radius + (kSlack - kTraceSlack) * robot_.safety_margin};
  free_ranges_ = way_space_.freeRanges(x, kDirections, view_.horizon);
  nodes_ = localTangentGraph(view_, way_space_, free_ranges_, radius);
  findReach();
}

// d_reach: the least distance to the goal of all places in sight that the robot could drive
// straight to.
void TangentBug::findReach() {
  const Eigen::Vector2d x = view_.T_map_robot.position();
  reach_map_ = x;
  d_reach_ = (goal_map_ - x).norm();
  const auto consider = [&](const Eigen::Vector2d& direction, double free) {
    const double ahead = std::clamp((goal_map_ - x).dot(direction), 0.0, free);
    const Eigen::Vector2d p = x + ahead * direction;
    const double distance = (goal_map_ - p).norm();
    if (distance >= d_reach_ || !view_.inFieldOfView(p) || isInVain(p)) return;
    d_reach_ = distance;
    reach_map_ = p;
  };
  for (std::size_t k = 0; k < kDirections.size(); ++k)
    consider(kDirections[k], free_ranges_[k].distance);
  for (const TangentNode& node : nodes_) {
    const double length = (node.p_map - x).norm();
    if (length > 0.0) consider((node.p_map - x) / length, length);
  }
  const double d_goal = (goal_map_ - x).norm();
  if (d_goal == 0.0) return;
  const Eigen::Vector2d towards_goal = (goal_map_ - x) / d_goal;
  consider(towards_goal, way_space_.freeDistance(x, towards_goal, std::min(d_goal, view_.horizon)));
}

// From half as far away the beams are twice as dense: then what they show counts again. The goal
// itself may lie beside a place that a door post hid from afar.
bool TangentBug::isInVain(const Eigen::Vector2d& p_map) const {
  const double distance = (p_map - view_.T_map_robot.position()).norm();
  return std::any_of(in_vain_.begin(), in_vain_.end(), [&](const InVain& place) {
    return (place.p_map - p_map).norm() < kInVain && distance > kLookAgain * place.distance;
  });
}

std::optional<Eigen::Vector2d> TangentBug::moveToGoal() {
  const Eigen::Vector2d x = view_.T_map_robot.position();
  motion_to_goal_.correctPlace(x, goal_map_, way_space_, reach_map_);
  const auto target = motion_to_goal_.step(x, goal_map_, way_space_, nodes_, view_.horizon);
  if (const auto place = motion_to_goal_.reachedInVain()) {
    in_vain_.push_back({*place, (*place - x).norm()});
  }
  return target ? target : startFollowing();
}

std::optional<Eigen::Vector2d> TangentBug::startFollowing() {
  const Eigen::Vector2d x = view_.T_map_robot.position();
  const Eigen::Vector2d towards_goal = (goal_map_ - x).normalized();
  const double free = trace_space_.freeDistance(x, towards_goal, view_.horizon);
  const Eigen::Vector2d hit = x + free * towards_goal;
  // In the last direction: where the robot was heading left of the goal, it has the obstacle that
  // lies towards the goal on its right.
  const Eigen::Vector2d last =
      motion_to_goal_.lastDirection().value_or(view_.T_map_robot.heading());
  const bool on_the_right = cross(towards_goal, last) > 0.0;
  if (!started_at_map_ || (x - *started_at_map_).norm() > kSameArea) {
    started_at_map_ = x;
    ++tries_;
  }
  follower_.start(hit, on_the_right, goal_map_, view_, trace_space_);
  if (follower_.trace().empty()) {  // out of sight: the boundary beside the robot then
    follower_.start(x, on_the_right, goal_map_, view_, trace_space_);
  }
  progress_.startWalk(time_);
  state_ = TangentBugState::kBoundaryFollowing;
  return followBoundary();
}

std::optional<Eigen::Vector2d> TangentBug::followBoundary() {
  const auto target = follower_.step(goal_map_, view_, trace_space_, way_space_, d_reach_);
  const double unsure = kUnsure * (reach_map_ - view_.T_map_robot.position()).norm();
  if (d_reach_ < follower_.followedDistance() - kLeave - unsure || d_reach_ < kAtTheGoal) {
    state_ = TangentBugState::kMotionToGoal;
    const double farthest = std::max(follower_.followedDistance() - 0.5 * kLeave, kGoalTolerance);
    motion_to_goal_.startFromBoundary(reach_map_, farthest, follower_.onTheRight());
    return reach_map_;
  }
  if (follower_.circled() || tries_ > kMostTries) {
    state_ = TangentBugState::kUnreachable;
    return std::nullopt;
  }
  if (target) {
    lost_.stop();
    return target;
  }
  // Noise hides a boundary for a moment; what moved away takes it along.
  lost_.run(time_);
  if (lost_.isOver(kLost, time_)) {
    lost_.stop();
    state_ = TangentBugState::kMotionToGoal;
    motion_to_goal_.start();
  }
  return std::nullopt;
}

}  // namespace cca
