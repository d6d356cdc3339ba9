// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "navigation/planning/goal_blacklist.hpp"
#include "navigation/world/grid_paths.hpp"
#include "navigation/world/world_model.hpp"

namespace cca {

/// What the planner plans with: the world as it is known, less what was tried in vain, and the
/// shortest paths in it. It refers to all three.
class PlanningScene {
 public:
  PlanningScene(const WorldModel& world, GoalBlacklist& blacklist, DistanceField& distances)
      : world_(world), blacklist_(blacklist), distances_(distances) {}

  const WorldModel& world() const { return world_; }
  const ExplorationGrid& grid() const { return world_.grid(); }
  /// Where paths may lead.
  PassableSpace space() const { return {world_.space(), blacklist_.blocked()}; }

  /// Finds the shortest paths from a place (m, map frame) anew: to everywhere, or at least to
  /// `until`. Cost: O(known blocks).
  void findPaths(const Eigen::Vector2d& from_map, std::optional<Cell> until = std::nullopt) {
    distances_.search(space(), grid().resolution(), grid().cellOf(from_map), until);
  }
  /// The lengths of the paths last found.
  const DistanceField& distances() const { return distances_; }
  /// The shortest of them to a cell: corners, m, map frame; empty where there is none.
  std::vector<Eigen::Vector2d> pathTo(Cell goal) const {
    return shortestPath(space(), grid().resolution(), distances_, goal);
  }

  /// Whether nothing more is to be seen from a cell: all directions have been looked into, or a
  /// look has shown nothing.
  bool isExhausted(Cell c) const {
    return world_.scanned().contains(c) || blacklist_.isExhausted(c);
  }
  void addExhausted(Cell c) { blacklist_.addExhausted(c); }
  /// Whether a target failed, and may not be tried again yet.
  bool isBlacklisted(Cell target) const { return blacklist_.contains(target, grid().revealed()); }
  /// See GoalBlacklist::add().
  bool addFailure(Cell target, Failure failure, std::optional<Cell> held_at = {}) {
    return blacklist_.add(target, failure, grid().revealed(), held_at);
  }
  /// Whether the robot was held at one place in all of its last tries, as often as it may.
  bool isHeld() const { return blacklist_.timesHeld() >= GoalBlacklist::kMostTries; }
  /// See GoalBlacklist.
  void blockPath(const std::vector<Eigen::Vector2d>& path) {
    blacklist_.blockPath(path, grid().resolution(), grid().revealed());
  }
  bool unblock() { return blacklist_.unblock(grid().revealed()); }

 private:
  const WorldModel& world_;
  GoalBlacklist& blacklist_;
  DistanceField& distances_;
};

}  // namespace cca
