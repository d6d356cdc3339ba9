// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cca_mrpt/navigation/place/cell.hpp"

namespace cca {

/// Goals that are not to be tried for now: they proved unreachable, or were reached and nothing was
/// seen. How much of the map has changed since then is told by `revealed`, the number of cells that
/// the grid has ever come to know. Goals within 15 cm of each other are one.
/// Cost: O(goals set aside) each.
class AsideGoals {
 public:
  void add(Cell target, std::size_t revealed);

  /// Notes that the way to a goal was lost, half-way there. A passage about as wide as the robot
  /// may look open from afar and shut from nearby, each time that the robot comes: once may be
  /// somebody in the way.
  /// @return whether it was lost before.
  bool noteLostWay(Cell target);

  /// Whether it was set aside, and less than 10 m^2 have been seen since then.
  bool contains(Cell target, std::size_t revealed) const;

  /// The map has been made anew, and as much of it is revealed now.
  void move(const CellMove& moved, std::size_t revealed);

 private:
  struct Aside {
    Cell target;
    std::size_t revealed_then;
  };

  std::vector<Aside> aside_;
  std::vector<Cell> lost_ways_;
};

}  // namespace cca
