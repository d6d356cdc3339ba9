// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "navigation/control/tangent_bug/tangent_graph.hpp"

namespace cca {

/// Motion to goal [Kamon, Rimon & Rivlin 1998, Sec. 3]: towards the node O of the local tangent
/// graph that minimises d(x, O) + d(O, goal), for as long as that heuristic falls.
class MotionToGoal {
 public:
  /// Starts with the way to either side open.
  void start() { *this = {}; }

  /// Starts on leaving a boundary: first to the place that was closer to the goal than all of the
  /// boundary, and never again farther than that. The side is kept.
  /// @param farthest  m, from the goal.
  void startFromBoundary(const Eigen::Vector2d& reach_map, double farthest, bool on_the_right);

  /// Where the place that it started for has moved out of reach, by the millimetres that a corner
  /// moves when seen from nearer, another one as near to the goal as promised takes its place.
  /// @param reach_map  of all places in sight that the robot could drive straight to, the one
  ///                   nearest to the goal.
  void correctPlace(const Eigen::Vector2d& x_map, const Eigen::Vector2d& goal_map,
                    const ConfigurationSpace& space, const Eigen::Vector2d& reach_map);

  /// @param space    in which the ways are free.
  /// @param horizon  m, how far the robot sees.
  /// @return where to head for; none where the heuristic no longer falls: a boundary is to be
  ///         followed then.
  std::optional<Eigen::Vector2d> step(const Eigen::Vector2d& x_map, const Eigen::Vector2d& goal_map,
                                      const ConfigurationSpace& space,
                                      const std::vector<TangentNode>& nodes, double horizon);

  /// The place that it started for, where that turned out not to be free, or not as close to the
  /// goal as it had looked from afar.
  std::optional<Eigen::Vector2d> reachedInVain() const {
    return in_vain_ ? reach_map_ : std::nullopt;
  }

  /// Map frame, towards the last node chosen, not of unit length; none before the first one.
  std::optional<Eigen::Vector2d> lastDirection() const { return last_direction_; }

 private:
  std::optional<Eigen::Vector2d> reach_map_;
  bool in_vain_ = false, changed_side_ = false;
  double farthest_ = std::numeric_limits<double>::infinity();   ///< m, allowed from the goal
  double heuristic_ = std::numeric_limits<double>::infinity();  ///< m, the least so far
  std::optional<bool> on_the_right_;  ///< the side of the obstacle that is passed
  std::optional<Eigen::Vector2d> last_direction_;
};

}  // namespace cca
