// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/control/tangent_bug/motion_to_goal.hpp"

#include <algorithm>

namespace cca {
namespace {

// m, by which the other way around must promise more than this one still does. It may be tried
// once; from then on it must promise more than any way ever did.
constexpr double kOtherWay = 1.0;
constexpr double kFalling = 0.3;   // m, by which the heuristic may rise: corners come into sight
constexpr double kAtReach = 0.03;  // m, below what leaving a boundary must gain

// The way may end just before the place: it lies on the edge of what is free.
bool leadsTo(const ConfigurationSpace& space, const Eigen::Vector2d& x_map,
             const Eigen::Vector2d& place_map) {
  const double length = (place_map - x_map).norm();
  return length <= kAtReach ||
         space.freeDistance(x_map, (place_map - x_map) / length, length) >= length - kAtReach;
}

}  // namespace

void MotionToGoal::startFromBoundary(const Eigen::Vector2d& reach_map, double farthest,
                                     bool on_the_right) {
  start();
  on_the_right_ = on_the_right;
  reach_map_ = reach_map;
  farthest_ = farthest;
}

void MotionToGoal::correctPlace(const Eigen::Vector2d& x_map, const Eigen::Vector2d& goal_map,
                                const ConfigurationSpace& space, const Eigen::Vector2d& reach_map) {
  const bool better = (goal_map - reach_map).norm() < farthest_;
  if (reach_map_ && better && !leadsTo(space, x_map, *reach_map_)) reach_map_ = reach_map;
}

std::optional<Eigen::Vector2d> MotionToGoal::step(const Eigen::Vector2d& x_map,
                                                  const Eigen::Vector2d& goal_map,
                                                  const ConfigurationSpace& space,
                                                  const std::vector<TangentNode>& nodes,
                                                  double horizon) {
  const double d_goal = (goal_map - x_map).norm();
  if (d_goal == 0.0) return goal_map;
  const double in_sight = std::min(d_goal, horizon);
  const Eigen::Vector2d towards_goal = (goal_map - x_map) / d_goal;
  if (space.freeDistance(x_map, towards_goal, in_sight) >= in_sight) {
    if (!reach_map_) heuristic_ = std::min(heuristic_, d_goal);
    return x_map + towards_goal * in_sight;
  }
  if (reach_map_) {
    const bool there = (*reach_map_ - x_map).norm() < kAtReach;
    if (!there && d_goal > farthest_ && leadsTo(space, x_map, *reach_map_)) {
      last_direction_ = *reach_map_ - x_map;
      return reach_map_;
    }
    in_vain_ = d_goal > farthest_;
    if (in_vain_) return std::nullopt;
    reach_map_.reset();
  }
  if (d_goal > farthest_) return std::nullopt;
  const TangentNode* best = nullptr;
  double least = std::numeric_limits<double>::infinity(), h_best = 0.0;
  for (const TangentNode& node : nodes) {
    const double h = (node.p_map - x_map).norm() + (goal_map - node.p_map).norm();
    const bool other_way = on_the_right_ && *on_the_right_ != node.obstacle_on_the_right;
    const double cost = h + (other_way ? kOtherWay : 0.0);
    if (cost >= least || (other_way && changed_side_ && h > heuristic_ - kFalling)) continue;
    least = cost;
    h_best = h;
    best = &node;
  }
  if (!best || h_best > heuristic_ + kFalling) return std::nullopt;
  heuristic_ = std::min(heuristic_, h_best);
  changed_side_ = changed_side_ || (on_the_right_ && *on_the_right_ != best->obstacle_on_the_right);
  on_the_right_ = best->obstacle_on_the_right;
  last_direction_ = best->p_map - x_map;
  return best->p_map;
}

}  // namespace cca
