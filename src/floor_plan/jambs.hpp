// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "floor_plan/passages.hpp"

namespace cca {

struct JambTuning {
  double search = 0.13;   ///< m along the passage from the jamb of cells: two and a half of 5 cm
  double sideways = 0.4;  ///< m across: the faces of a wall lie that far from its middle
};

/// Moves the jambs of a passage from cells to what the lines say: to where the passage meets a line
/// across it (the reveal, or the flank of a wall); else half way to the end of the line along it (a
/// face of the wall) that reaches farthest in. A jamb without lines stays.
/// Cost: O(lines).
Passage withJambsOfLines(const Passage& passage, const std::vector<MapLine>& lines,
                         const JambTuning& tuning = {});

}  // namespace cca
