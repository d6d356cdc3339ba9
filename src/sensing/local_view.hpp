// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// What one scan says to the local planner.
struct LocalView {
  Pose2 T_map_robot;
  Pose2 T_map_sensor;
  std::vector<Eigen::Vector2d> obstacles;  ///< m, map frame, counter-clockwise around the sensor;
                                           ///< walls are sampled without holes
  std::vector<Eigen::Vector2d> returns;    ///< m, map frame: all that stands still. The obstacles
                                           ///< leave out what lies within 2.5 cm of the one before,
                                           ///< which may be a corner.
  std::vector<bool> ends_here;  ///< by obstacle: the surface ends between it and the next one
  std::vector<Eigen::Vector2d> movers;  ///< m, map frame, points of what moves
  std::vector<double> seen;  ///< m, beam by beam: seen free up to here; 0 for an invalid beam
  double angle_min = 0.0;
  double angle_increment = 0.0;
  double range_sigma = 0.0;  ///< m, of the scan before it was smoothed
  double horizon = 0.0;      ///< m, the farthest that any beam sees

  /// @return the beam next to the point's bearing; -1 outside the field of view.
  int beamTowards(const Eigen::Vector2d& p_map) const;
  bool inFieldOfView(const Eigen::Vector2d& p_map) const { return beamTowards(p_map) >= 0; }

  /// @return m, how far the beam next to the point's bearing sees, measured from the sensor; 0
  ///         outside the field of view.
  double seenDistanceTowards(const Eigen::Vector2d& p_map) const;

  /// Whether two obstacle points lie on one surface, on the shorter way around the sensor.
  /// Cost: O(points between).
  bool onOneSurface(int a, int b) const;

  /// @return the last obstacle point of the surface of `from`, counter-clockwise or clockwise.
  /// Cost: O(points between).
  int surfaceEnd(int from, bool counter_clockwise) const;
};

/// Reads a scan as obstacle points.
///
/// Neighbouring returns belong to one surface where their distance is below that of a surface seen
/// at 10 degrees of grazing incidence [adaptive breakpoints, Borges & Aldon 2004], or below
/// `passable_gap`, through which no robot fits. Surfaces are sampled at most `spacing` apart.
///
/// @param scan          invalid beams are passed over; a scan without any valid beam sees nothing.
/// @param moving        by beam; empty where nothing moves.
/// @param passable_gap  m, the robot's diameter with its margins.
/// Cost: O(beams + samples).
LocalView makeLocalView(const Scan& scan, const std::vector<bool>& moving, const Pose2& T_map_robot,
                        double passable_gap);

}  // namespace cca
