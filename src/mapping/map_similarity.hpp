// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "mapping/map_noise.hpp"
#include "mapping/similarity.hpp"
#include "mapping/wall.hpp"
#include "mapping/wall_index.hpp"

namespace cca {

/// A line of a new scan, in the map frame, its sensor on the left.
struct NewLine {
  LineSegment segment;                                  ///< the covariance holds the pose error too
  Eigen::Vector2d viewpoint = Eigen::Vector2d::Zero();  ///< m, map frame
  double own_offset_variance = 0.0;                     ///< m^2, range noise alone
  double own_angle_variance = 0.0;                      ///< rad^2
  WallIndex::Slot wall = -1;                            ///< where it belongs; -1 nowhere
};

// The five memberships of what the map knows and learns. Each is a bell() that stands at 1/2 at its
// gate, and each prevents a mistake that no other sees:
//
//   orientation  a wall and what leaves it at an angle, however near its end
//   offset       a wall and its parallel: a niche, a step, the next face on the same side
//   gap          two walls of one line, a room or a door apart
//   fit          what lies on the line that a short line promises, but off what both have shown
//   overlap      what is seen side by side: parallels, and the two faces of a thin wall
//
// The growth of the residuals by a common line parts exactly into one share of the angle and one of
// the offset at the place where the two are uncorrelated: these are the first two, in units of
// their variances. Gates are 99.9 % quantiles.

/// m, across which a wall is still the same to even odds where one of the two was seen once.
inline constexpr double kGapOfLine = 0.4;

/// A new line and a wall. From one look nobody can tell whether a face that looks the other way is
/// that of a thin wall: overlap is 0 there, unless the wall is known to be two-sided.
/// @return  all 0 where the wall would outgrow kLongestWall.
Memberships mapMemberships(const NewLine& line, const Wall& wall, const MapNoise& noise);

/// Two walls. What they hold has been seen often, each time at its own pose error: bins are
/// independent, but of two fronts side by side only one can be seen: what parts them is one error,
/// and the overlap is asked alone. Else it asks whether they look the same way.
/// @return  all 0 where one wall would be longer than kLongestWall.
/// Cost: O(1), and O(bins) where the two lie side by side.
Memberships mapMemberships(const Wall& a, const Wall& b, const MapNoise& noise);
/// Whether one wall of both would be longer than kLongestWall.
bool wouldOutgrow(const Wall& a, const Wall& b);
/// The memberships of two walls, however long both together are.
Memberships membershipsOfAnyLength(const Wall& a, const Wall& b, const MapNoise& noise);

/// m, up to which two faces that look opposite ways are taken for one thin wall: its line may be
/// that of either, or any between them.
double mostBetweenFaces(const MapNoise& noise);

/// mu_5 of a place that one wall holds beside hits of another, `off` [m] from the other's line.
double overlapOfPlace(double off, const MapNoise& noise);

}  // namespace cca
