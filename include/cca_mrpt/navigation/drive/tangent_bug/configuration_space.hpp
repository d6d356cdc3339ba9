// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

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

  /// The free distance in all directions at once, at the bearings 2 pi k / bearings of the map
  /// frame. Cost: O(obstacles * the bearings that each one covers), some 50 us.
  std::vector<FreeRange> freeRanges(const Eigen::Vector2d& from, int bearings,
                                    double longest) const;

  /// @return m, distance from a point to the nearest obstacle point; +inf where there is none.
  double clearance(const Eigen::Vector2d& p_map) const;
};

}  // namespace cca
