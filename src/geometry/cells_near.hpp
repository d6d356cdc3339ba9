// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "cca_mrpt/geometry/cell.hpp"

namespace cca {

/// Visits the cells that a segment comes near to, as blocks around points of it that are half a
/// cell apart at most; blocks overlap.
///
/// @param margin  m, how near. @param side  m, of a cell.
/// @param visit   void(Cell low, Cell high): the corners of a block, both part of it.
/// Cost: O(length / side).
template <class Visit>
void visitCellsNear(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double margin,
                    double side, Visit&& visit) {
  const Eigen::Vector2d along = to - from, around = Eigen::Vector2d::Constant(margin);
  const int steps = 1 + static_cast<int>(std::ceil(along.norm() / (0.5 * side)));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d p = from + along * (static_cast<double>(i) / steps);
    visit(cellAt((p - around) / side), cellAt((p + around) / side));
  }
}

}  // namespace cca
