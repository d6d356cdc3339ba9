// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/map_line.hpp"

namespace cca {

/// A direction that walls share, those that stand square to it included.
struct MainDirection {
  double angle = 0.0;     ///< rad, [0, pi / 2): of walls along it or square to it
  double variance = 0.0;  ///< rad^2, of the angle
};

struct DirectionTuning {
  /// Deviations by which two directions may differ, and a line from the one that it joins: with two
  /// one wall of twenty that is parallel is left as it is.
  double deviations = 2.0;
};

/// The directions of a building, found by clustering: the two neighbouring ones that differ least,
/// by the deviations of both, become one, until none are alike.
/// @param lines  those with a variance of their direction (covariance(1, 1)) count.
/// @return       by angle. Cost: O(n^2) for n lines.
std::vector<MainDirection> mainDirections(const std::vector<MapLine>& lines,
                                          const DirectionTuning& tuning = {});

/// The lines, each turned about its middle into the best known main direction that its own
/// deviations allow, if any: lines that are hardly known make directions, too, and no line is to
/// follow those. Ends move by no more than what is not known of them.
std::vector<MapLine> alongMainDirections(std::vector<MapLine> lines,
                                         const std::vector<MainDirection>& directions,
                                         const DirectionTuning& tuning = {});

}  // namespace cca
