// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "box_world.hpp"

namespace cca::testing {

/// A world in which a simpler planner gets lost.
struct Trap {
  std::string name;
  BoxWorld world;
  Pose2 start;
  Eigen::Vector2d goal;
  double size = 0.0;  ///< m, of the square frame
  bool reachable = true;
};

inline Trap concavePocket() {
  Trap trap{"concave_pocket", {}, {2.0, 6.0, 0.0}, {10.0, 6.0}, 12.0, true};
  trap.world.addFrame(12, 12);
  trap.world.add(4.0, 2.8, 7.2, 3.0);
  trap.world.add(4.0, 9.0, 7.2, 9.2);
  trap.world.add(7.0, 2.8, 7.2, 9.2);
  return trap;
}

inline Trap spiral() {
  Trap trap{"spiral", {}, {6.5, 6.2, 0.0}, {1.0, 13.0}, 14.0, true};
  trap.world.addFrame(14, 14);
  auto& w = trap.world;
  // Two and a half turns of a corridor 1.2 m wide, opening at the left below.
  w.add(2.0, 2.0, 12.0, 2.2);
  w.add(12.0, 2.0, 12.2, 12.2);
  w.add(2.0, 12.0, 12.0, 12.2);
  w.add(2.0, 3.6, 2.2, 12.0);
  w.add(2.0, 3.6, 10.4, 3.8);
  w.add(10.4, 3.6, 10.6, 10.4);
  w.add(3.8, 10.4, 10.6, 10.6);
  w.add(3.8, 5.2, 4.0, 10.4);
  w.add(3.8, 5.2, 8.8, 5.4);
  w.add(8.8, 5.2, 9.0, 8.8);
  w.add(5.4, 8.8, 9.0, 9.0);
  return trap;
}

inline Trap comb() {
  Trap trap{"comb", {}, {1.5, 1.0, 0.0}, {13.0, 1.0}, 14.0, true};
  trap.world.addFrame(14, 6);
  for (int i = 0; i < 5; ++i) trap.world.add(2.5 + 2.0 * i, 0.0, 2.7 + 2.0 * i, 4.8);
  return trap;
}

inline Trap ringAroundTheGoal(bool closed) {
  Trap trap{
      closed ? "closed_ring" : "ring_with_a_gap", {}, {1.0, 5.0, 0.0}, {6.0, 5.0}, 10.0, !closed};
  trap.world.addFrame(10, 10);
  trap.world.add(4.0, 3.0, 8.0, 3.2);
  trap.world.add(4.0, 6.8, 8.0, 7.0);
  trap.world.add(4.0, 3.0, 4.2, 7.0);
  trap.world.add(7.8, 3.0, 8.0, closed ? 7.0 : 5.9);
  return trap;
}

/// A corridor with bends, wide enough for the robot, its margins and 6 cm.
inline Trap narrowCorridor() {
  Trap trap{"narrow_corridor", {}, {1.0, 1.0, 0.0}, {7.0, 7.0}, 8.0, true};
  trap.world.addFrame(8, 8);
  constexpr double kWidth = 0.66;
  trap.world.add(2.0, 0.0, 5.0, 4.0 - kWidth / 2);
  trap.world.add(2.0, 4.0 + kWidth / 2, 5.0 - kWidth, 8.0);
  trap.world.add(5.0, 0.0, 5.2, 6.0);
  trap.world.add(5.0 - kWidth, 6.0 + kWidth, 5.2, 8.0);
  return trap;
}

inline std::vector<Trap> allTraps() {
  return {concavePocket(),         spiral(),        comb(), ringAroundTheGoal(false),
          ringAroundTheGoal(true), narrowCorridor()};
}

}  // namespace cca::testing
