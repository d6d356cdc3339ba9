// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cca_mrpt/simulation/mover.hpp"
#include "cca_mrpt/simulation/world.hpp"
#include "simulation/random.hpp"

namespace cca {

/// Movers on their way.
class Movers {
 public:
  Movers(const std::vector<Mover>& movers, std::uint64_t seed);

  /// @param p_robot   m; @param robot_radius  m, of the disc that they stop at.
  /// @return          how many movers have newly driven into the robot.
  /// They go one after the other, in their order: each sees where those before it have got to.
  /// Cost: O(movers^2).
  int advance(const World& world, const Eigen::Vector2d& p_robot, double robot_radius, double dt);

  const std::vector<Body>& bodies() const { return bodies_; }

 private:
  struct Walk {
    Mover mover;
    Random random;
    std::size_t next = 1;  // way-point
    bool forwards = true;
    double heading = 0.0;  // rad, of a random walk
    double blocked = 0.0;  // s, since it last moved
    bool touching = false;
  };
  double headingOf(const Walk& walk, const Body& body) const;
  bool comesIntoAnother(std::size_t i, const Eigen::Vector2d& p_map) const;
  void turnAway(Walk& walk) const;
  void passWayPoint(Walk& walk, const Eigen::Vector2d& p_map) const;

  std::vector<Walk> walks_;
  std::vector<Body> bodies_;
};

}  // namespace cca
