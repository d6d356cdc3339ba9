// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cca_mrpt/simulation/world.hpp"

namespace cca::evidence {

/// A way through a world on which a robot sees nearly everything, whatever the map: from the
/// world's start it goes, again and again, to the nearest place farther than `reach` from its way
/// so far.
struct TourParameters {
  double cell = 0.25;       ///< m, of the grid that the way is found on
  double clearance = 0.35;  ///< m, from obstacles
  double reach = 3.0;       ///< m
  double step = 0.4;        ///< m, between poses
};

/// @return  poses facing along the way, at most `most_poses`.
/// @throws std::runtime_error where the world has no place to start from.
/// Cost: O(cells) for each place that is gone to.
std::vector<Pose2> tour(const World& world, std::size_t most_poses, const TourParameters& p = {});

}  // namespace cca::evidence
