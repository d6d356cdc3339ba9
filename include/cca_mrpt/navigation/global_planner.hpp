// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cca_mrpt/navigation/exploration_grid.hpp"
#include "cca_mrpt/navigation/free_space.hpp"
#include "cca_mrpt/navigation/frontier.hpp"
#include "cca_mrpt/navigation/goal_selection.hpp"
#include "cca_mrpt/navigation/grid_paths.hpp"

namespace cca {

struct GlobalPlannerParameters {
  std::string strategy = "gain_distance";
  double clearance = 0.30;       ///< m
  double smallest_gain = 0.01;   ///< m^2, frontiers that promise less are left
  double smallest_frontier = 1;  ///< cells
};

/// Where to go next, and how.
struct Plan {
  bool finished = false;
  std::vector<Eigen::Vector2d> path;  ///< m, map frame, from the robot to the goal; corner points
  std::string reason;
};

/// The paper's global planner: keeps what is known of the place, and sets one goal after the other.
class GlobalPlanner {
 public:
  explicit GlobalPlanner(const GlobalPlannerParameters& parameters = {});

  /// Takes a scan; decides anew where the present goal is reached, seen or no longer on a free way.
  const Plan& update(const Scan& scan, const Eigen::Vector2d& robot_map);

  /// Sets the present goal aside until the map around it has changed.
  void setGoalAside();

  const ExplorationGrid& grid() const { return grid_; }
  const FreeSpace& space() const { return space_; }
  const FrontierCells& frontierCells() const { return frontier_cells_; }
  const std::vector<ViewPoint>& viewPoints() const { return view_points_; }
  const Plan& plan() const { return plan_; }

 private:
  void learnRange(const Scan& scan);
  bool goalStands(const Eigen::Vector2d& robot_map) const;
  void findViewPoints();
  void decide(const Eigen::Vector2d& robot_map);
  bool isAside(Cell target) const;

  struct Aside {
    Cell target;
    std::size_t known_when_set;
  };

  GlobalPlannerParameters parameters_;
  Strategy strategy_;
  ExplorationGrid grid_;
  FreeSpace space_;
  FrontierCells frontier_cells_;
  DistanceField field_;
  std::vector<ViewPoint> view_points_;
  std::vector<Aside> aside_;
  ViewPoint goal_;
  bool has_goal_ = false;
  double laser_range_ = 1.0;  ///< m, the longest that a beam was seen to be free
  std::size_t changes_ = 0;
  Plan plan_;
};

}  // namespace cca
