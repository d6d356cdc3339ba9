// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/mapping/map_noise.hpp"
#include "cca_mrpt/mapping/walls.hpp"

namespace cca {

/// A line of a new scan, in the map frame, its sensor on the left.
struct NewLine {
  LineSegment segment;                                  ///< the covariance holds the pose error too
  Eigen::Vector2d viewpoint = Eigen::Vector2d::Zero();  ///< m, map frame
  std::size_t scan = 0;                                 ///< in its batch
  double own_offset_variance = 0.0;                     ///< m^2, range noise alone
  double own_angle_variance = 0.0;                      ///< rad^2
  Walls::Slot wall = -1;                                ///< where it belongs; -1 nowhere
};

/// The paper's last step: the new lines are clustered against the map's lines. Each line meets only
/// the walls near it; what is alike, directly or through others, makes one neighbourhood; the
/// Similarity Index Matrix and Rank Order Clustering run on that. The lines of a group go to the
/// wall of the group that they are most alike; a group without a wall founds one, unless the map
/// explains its lines already.
///
/// Several walls in one group are told to compare themselves with each other (see wall_upkeep.hpp).
///
/// @param cut  alpha-cut in (0, 1].
/// Cost: O(lines x walls near a line), whatever the size of the map.
void clusterIntoMap(std::vector<NewLine>& lines, double cut, const MapNoise& noise, Walls& walls);

}  // namespace cca
