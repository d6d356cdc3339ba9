// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/simulation/body.hpp"
#include "cca_mrpt/simulation/random.hpp"
#include "cca_mrpt/simulation/world.hpp"

namespace cca {

/// Something that moves about: a person, a trolley. The smallest circle around one keeps out of
/// every obstacle cell and of the circles of all other movers; where it would come into one, it
/// turns (a random walk anywhere, others round). Those whose circles overlap at the start may part.
struct Mover {
  Body body;                                ///< where and how it begins
  double speed = 0.8;                       ///< m/s
  double gap = 0.4;                         ///< m, where it stops before the robot; 0: blind to it
  std::vector<Eigen::Vector2d> way_points;  ///< m; fewer than two: it walks at random
  bool loop = false;                        ///< from the last way-point to the first; else back
};

/// Reads `movers:`, a list of {shape: disc|box, radius | size, speed, gap, and either way_points
/// [[x, y], ...] with loop, or start [x, y] of a random walk}.
/// @throws std::runtime_error naming file, mover, key and what is allowed; also where a mover would
///         have to pass through a wall.
std::vector<Mover> loadMovers(const std::string& yaml_path, const World& world);

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
