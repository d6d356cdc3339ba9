// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/navigation/place/free_space.hpp"

namespace cca {

/// Stretches of way that look free and that the robot could not drive: passages of about its own
/// width, where the grid and Tangent Bug disagree by a centimetre, or somebody who stands there.
/// All further ways lead around them. Without that, every goal behind such a passage was tried in
/// turn.
class BarredWays {
 public:
  /// Bars the first 60 cm of a way, 25 cm wide; cells that the robot has been in stay open.
  /// @param way  corners, m, map frame, from where the robot got no farther.
  /// Cost: O(1).
  void bar(const std::vector<Eigen::Vector2d>& way, double resolution, FreeSpace& space);

  /// Bars in a space that was made anew what was barred before.
  void move(const CellMove& moved, FreeSpace& space);

  /// Opens what was barred last. Cost: O(cells barred).
  void openLast(FreeSpace& space);

  /// Opens all. @return whether there were any. Cost: O(cells barred).
  bool openAll(FreeSpace& space);

 private:
  std::vector<std::vector<Cell>> ways_;
};

}  // namespace cca
