// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../slam/walled_world.hpp"
#include "cca_mrpt/known_map/known_map.hpp"

namespace cca::test {

/// A world, and the plan that its walls are drawn in; what is added to the world alone is
/// furniture.
struct PlannedWorld {
  PlannedWorld() = default;
  explicit PlannedWorld(const WalledWorld& drawn) : world(drawn), plan(drawn.walls()) {}
  void addWall(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    world.addWall(a, b);
    plan.emplace_back(a, b);
  }
  void addBox(double x0, double y0, double x1, double y1) {
    addWall({x0, y0}, {x1, y0});
    addWall({x1, y0}, {x1, y1});
    addWall({x1, y1}, {x0, y1});
    addWall({x0, y1}, {x0, y0});
  }
  WalledWorld world;
  std::vector<PlanLine> plan;
};

/// A room of 8 x 6 m with a niche and a slanted wall, so that it is like none of its turns.
inline PlannedWorld roomWithNiche() {
  PlannedWorld room;
  room.addWall({0, 0}, {8, 0});
  room.addWall({8, 0}, {8, 4});
  room.addWall({8, 4}, {6, 6});
  room.addWall({6, 6}, {3, 6});
  room.addWall({3, 6}, {3, 5});
  room.addWall({3, 5}, {0, 5});
  room.addWall({0, 5}, {0, 0});
  return room;
}

inline Measurement measurementAt(WalledWorld& world, const Pose2& pose, const Pose2& wheels,
                                 double sigma = 0.01) {
  Measurement measurement;
  measurement.scan = world.scan(pose, 360, 2.0 * M_PI, sigma, 15.0);
  measurement.T_odom_robot = wheels;
  return measurement;
}

}  // namespace cca::test
