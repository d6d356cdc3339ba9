// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cca_mrpt/mapping/map_line.hpp"

namespace cca {

/// Two line ends that share a vertex.
struct Corner {
  struct End {
    std::size_t line = 0;  ///< in the vector of lines
    bool last = false;     ///< the line's end, not its start
  };
  End a, b;
};

/// Cuts off what of a line lies beyond another one that it meets, by no more than returns scatter
/// along it: a wall ends where the next one begins. An end loses half of its line at most.
/// @param lines    changed.
/// @param scatter  m. Cost: O(n) for n lines of a map.
void cutOvershoots(std::vector<MapLine>& lines, double scatter);

/// Moves ends that meet to the intersection of their lines: both within `reach` of it, at an angle
/// that fixes it. An end takes part in one corner, the tightest that it can have.
///
/// @param lines  changed: the ends at a corner are equal to the last bit afterwards.
/// @param reach  m, that an end may be moved along its line.
/// Cost: O(n log n) for n lines of a map in which only a few ends crowd one place.
std::vector<Corner> joinCorners(std::vector<MapLine>& lines, double reach);

/// Chains lines along their corners. A line without corners is a chain of one. Chains come in the
/// order of the first line of each, open ones first.
std::vector<PolyLine> chainLines(const std::vector<MapLine>& lines,
                                 const std::vector<Corner>& corners);

}  // namespace cca
