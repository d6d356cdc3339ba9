// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/navigation/drive/local_view.hpp"
#include "cca_mrpt/navigation/drive/tangent_bug/configuration_space.hpp"

namespace cca {

/// A place beside an obstacle's visible end that the robot's centre can drive to straight away.
struct TangentNode {
  Eigen::Vector2d p_map;     ///< m
  Eigen::Vector2d edge_map;  ///< m, the obstacle point that it passes
  bool obstacle_on_the_right = true;
};

/// The local tangent graph [Kamon, Rimon & Rivlin 1998, Sec. 2], a star: the robot's position is
/// joined to each node.
///
/// A node stands where the free distance of the configuration space jumps from one bearing to the
/// next, so it lies beside a corner, asin(radius / d) off, not on it. A jump is one between
/// obstacle points of different surfaces, farther apart than the robot is wide. Where the way
/// allows, the node lies a little further around the disc than the tangent touches, so that the
/// robot comes around the corner.
///
/// Deviation: the paper takes the jumps of the scan and grows the obstacles later; a grown corner
/// hides what the scan itself still shows.
///
/// @param space   around view.obstacles.
/// @param ranges  of `space`, seen from the robot.
/// @param radius  m, at which nodes pass their edges; the way to a node is asked of `space`, whose
///                radius is a little smaller.
/// Cost: O(bearings + jumps * obstacles).
std::vector<TangentNode> localTangentGraph(const LocalView& view, const ConfigurationSpace& space,
                                           const std::vector<FreeRange>& ranges, double radius);

}  // namespace cca
