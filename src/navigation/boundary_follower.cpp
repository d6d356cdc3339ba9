// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/boundary_follower.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr double kAhead = 4.0;   // m, traced in front of the robot
constexpr double kSensed = 8.0;  // m, traced each way for the first d_followed
constexpr double kLost = 0.3;    // m, how far the boundary may move between two steps
constexpr double kHidden = 0.1;  // m, beyond what a beam sees

bool isInSight(const LocalView& view, const Eigen::Vector2d& p_map) {
  const double distance = (p_map - view.T_map_sensor.position()).norm();
  return distance <= view.seenDistanceTowards(p_map) + kHidden;
}

}  // namespace

void BoundaryFollower::start(const Eigen::Vector2d& start_map, bool on_the_right,
                             const Eigen::Vector2d& goal_map, const LocalView& view,
                             const ConfigurationSpace& space) {
  on_the_right_ = on_the_right;
  anchor_map_ = start_map;
  length_ = 0.0;
  d_followed_ = INFINITY;
  circling_.reset();
  const auto seen = [&](const Eigen::Vector2d& p_map) { return isInSight(view, p_map); };
  include(traceBoundary(space, start_map, !on_the_right, kSensed, seen), goal_map);
  trace_ = traceBoundary(space, start_map, on_the_right, kSensed, seen);
  include(trace_, goal_map);
  heading_ = trace_.empty() ? 0.0 : trace_.front().heading;
}

std::optional<Eigen::Vector2d> BoundaryFollower::step(const Eigen::Vector2d& goal_map,
                                                      const LocalView& view,
                                                      const ConfigurationSpace& trace_space,
                                                      const ConfigurationSpace& way_space) {
  const auto seen = [&](const Eigen::Vector2d& p_map) { return isInSight(view, p_map); };
  trace_ = traceBoundary(trace_space, anchor_map_, on_the_right_, kAhead, seen);
  if (trace_.empty() || (trace_.front().center_map - anchor_map_).norm() > kLost) {
    return std::nullopt;
  }
  include(trace_, goal_map);
  const Eigen::Vector2d x = view.T_map_robot.position();
  std::size_t target = trace_.size() - 1;
  while (target > 0 && !way_space.isFree(x, trace_[target].center_map)) --target;
  moveAnchor(x, target);
  return trace_[target].center_map;
}

void BoundaryFollower::include(const std::vector<BoundaryPoint>& trace,
                               const Eigen::Vector2d& goal_map) {
  for (const BoundaryPoint& point : trace) {
    d_followed_ = std::min(d_followed_, (point.center_map - goal_map).norm());
  }
}

// To the trace's place nearest to the robot, up to the target.
void BoundaryFollower::moveAnchor(const Eigen::Vector2d& x_map, std::size_t last) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i <= last; ++i) {
    if ((trace_[i].center_map - x_map).norm() < (trace_[nearest].center_map - x_map).norm()) {
      nearest = i;
    }
  }
  // The trace is made anew each time: its first heading joins the walk's.
  heading_ += wrapAngle(trace_.front().heading - heading_);
  for (std::size_t i = 0; i <= nearest; ++i) {
    circling_.add(trace_[i].center_map, length_ + trace_[i].length,
                  heading_ + trace_[i].heading - trace_.front().heading);
  }
  anchor_map_ = trace_[nearest].center_map;
  length_ += trace_[nearest].length;
  heading_ += trace_[nearest].heading - trace_.front().heading;
}

}  // namespace cca
