// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/global_planner.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr int kFrontierExtent = 30;          // cells: longer frontiers are several
constexpr double kViewShare = 0.9;           // of the laser's range
constexpr double kGainRange = 4.0;           // m
constexpr double kArrived = 0.15;            // m
constexpr std::size_t kRetryChanges = 2000;  // cells changed until a goal set aside is tried again

}  // namespace

GlobalPlanner::GlobalPlanner(const GlobalPlannerParameters& parameters)
    : parameters_(parameters),
      strategy_(strategyNamed(parameters.strategy)),
      space_(parameters.clearance, grid_.resolution()) {}

const Plan& GlobalPlanner::update(const Scan& scan, const Eigen::Vector2d& robot_map) {
  learnRange(scan);
  grid_.insert(scan);
  space_.update(grid_, grid_.changed());
  frontier_cells_.update(grid_, grid_.changed());
  changes_ += grid_.changed().size();
  if (!goalStands(robot_map)) decide(robot_map);
  return plan_;
}

void GlobalPlanner::learnRange(const Scan& scan) {
  for (const double range : scan.ranges) {
    const double seen = isNoReturn(range) ? scan.free_range_without_return : range;
    if (isReturn(seen)) laser_range_ = std::max(laser_range_, seen);
  }
}

bool GlobalPlanner::goalStands(const Eigen::Vector2d& robot_map) const {
  if (!has_goal_ || grid_.at(goal_.target) != CellState::kUnknown) return false;
  if ((grid_.centreOf(goal_.cell) - robot_map).norm() < kArrived) return false;
  for (std::size_t i = 1; i < plan_.path.size(); ++i) {
    if (!isClearLine(space_, plan_.path[i - 1] / grid_.resolution(),
                     plan_.path[i] / grid_.resolution())) {
      return false;
    }
  }
  return true;
}

void GlobalPlanner::findViewPoints() {
  view_points_.clear();
  for (const Frontier& frontier : frontier_cells_.frontiers(kFrontierExtent)) {
    if (static_cast<double>(frontier.cells.size()) < parameters_.smallest_frontier) continue;
    const Cell target = unknownBeside(grid_, frontier.middle);
    if (isAside(target)) continue;
    const double gain = unknownAreaInView(grid_, frontier.middle, kGainRange);
    if (gain < parameters_.smallest_gain) continue;
    auto view_point = nearestViewPoint(grid_, space_, field_, target, kViewShare * laser_range_);
    if (!view_point) continue;
    view_point->gain = gain;
    view_points_.push_back(*view_point);
  }
}

void GlobalPlanner::decide(const Eigen::Vector2d& robot_map) {
  has_goal_ = false;
  plan_ = {};
  field_.search(space_, grid_.resolution(), grid_.cellOf(robot_map));
  findViewPoints();
  while (const auto best = selectGoal(strategy_, view_points_)) {
    goal_ = view_points_[*best];
    plan_.path = shortestPath(space_, grid_.resolution(), field_, goal_.cell);
    const bool is_here = (grid_.centreOf(goal_.cell) - robot_map).norm() < kArrived;
    if (!plan_.path.empty() && !is_here) {
      has_goal_ = true;
      plan_.reason = parameters_.strategy;
      return;
    }
    setGoalAside();
    view_points_.erase(view_points_.begin() + static_cast<std::ptrdiff_t>(*best));
  }
  plan_.path.clear();
  plan_.finished = true;
  plan_.reason = "no reachable frontier of useful size is left";
}

void GlobalPlanner::setGoalAside() {
  aside_.push_back({goal_.target, changes_});
  has_goal_ = false;
}

bool GlobalPlanner::isAside(Cell target) const {
  return std::any_of(aside_.begin(), aside_.end(), [&](const Aside& a) {
    return std::max(std::abs(a.target.x - target.x), std::abs(a.target.y - target.y)) <= 2 &&
           changes_ < a.known_when_set + kRetryChanges;
  });
}

}  // namespace cca
