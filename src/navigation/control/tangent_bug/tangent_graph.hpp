// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sensing/local_view.hpp"

namespace cca {

/// How far it is free in one direction, and which obstacle ends it.
struct FreeRange {
  double distance = 0.0;  ///< m
  int obstacle = -1;      ///< index into the obstacles; -1 where nothing is in the way
};

/// A round robot among obstacle points is a point among discs: its configuration space.
struct ConfigurationSpace {
  std::vector<Eigen::Vector2d> obstacles;  ///< m, map frame
  double radius = 0.0;                     ///< m, of the discs around them

  /// How far the robot's centre can go straight ahead.
  ///
  /// A centre that already lies inside a disc (noise, a start beside a wall) may leave it and slide
  /// along it: that disc counts as 1 cm smaller than the present distance.
  ///
  /// @param direction  unit vector. @param longest  m. @return  m, in [0, longest].
  /// Cost: O(obstacles).
  double freeDistance(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                      double longest) const;

  /// Whether the straight way is free; true for a way of no length.
  bool isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  /// The free distance in all directions at once.
  /// @param directions  as of directionsAround(), the first along x.
  /// Cost: O(obstacles * the directions that each one covers), some 50 us.
  std::vector<FreeRange> freeRanges(const Eigen::Vector2d& from,
                                    const std::vector<Eigen::Vector2d>& directions,
                                    double longest) const;

  /// @return m, distance from a point to the nearest obstacle point; +inf where there is none.
  double clearance(const Eigen::Vector2d& p_map) const;
};

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
/// next, between obstacle points of different surfaces that are farther apart than the robot is
/// wide: beside a corner, asin(radius / d) off, and a little further around where the way allows.
/// Deviation: the paper takes the jumps of the scan and grows the obstacles later; a grown corner
/// hides what the scan itself still shows.
/// @param space   around view.obstacles. @param ranges  of `space`, seen from the robot.
/// @param radius  m, at which nodes pass their edges; that of `space` is a little smaller.
/// Cost: O(bearings + jumps * obstacles).
std::vector<TangentNode> localTangentGraph(const LocalView& view, const ConfigurationSpace& space,
                                           const std::vector<FreeRange>& ranges, double radius);

}  // namespace cca
