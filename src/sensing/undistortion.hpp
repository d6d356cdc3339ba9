// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// A velocity in the plane, constant while a scan is taken, in the frame that moves.
struct Twist {
  Eigen::Vector2d linear{0.0, 0.0};  ///< m/s
  double angular = 0.0;              ///< rad/s, counter-clockwise
};

/// The twist that leads from one pose to another in dt seconds. Precondition: dt > 0; a turn of
/// less than half a circle.
Twist twistBetween(const Pose2& from, const Pose2& to, double dt);

/// Where constant motion leads to in dt seconds, which may be negative.
Pose2 moveBy(const Twist& twist, double dt);

/// Of the range: neighbouring beams whose ranges differ by less are of one surface.
inline constexpr double kOneSurface = 0.1;

/// Brings a scan to the middle of its sweep: motion compensation, or de-skewing.
///
/// A laser that turns measures each beam from where it is by then. Each return is moved to where it
/// lies seen from the laser's pose in the middle of the sweep, p = T_middle_sensor(t_i) p_i, and
/// the scan is made anew on its own bearings: each beam takes the return next to its bearing, moved
/// along the surface that the neighbours of that return show, never across a step in depth. Where
/// the sweep has left a gap the beam is invalid; where it overlaps itself the nearest one counts. A
/// beam looks up to half a spacing beside the bearing that it is taken for: bearing_sigma.
///
/// @param scan    with its sweep_duration; see there.
/// @param before, after  of the sensor, in its own frame as in the middle of the sweep: before it,
///                and after it.
/// @return        the scan with sweep_duration 0. Equal to `scan` in all else where there is no
///                sweep, or where the motion is no matter: below a twentieth of a beam's spacing
///                and a millimetre at either end.
/// Cost: O(beams).
Scan undistort(const Scan& scan, const Twist& before, const Twist& after);
/// Whether there is something to undo.
bool isBent(const Scan& scan, const Twist& before, const Twist& after);
inline Scan undistort(const Scan& scan, const Twist& sensor) {
  return undistort(scan, sensor, sensor);
}

/// The twist of a sensor on a robot that moves by `robot`.
Twist sensorTwist(const Twist& robot, const Pose2& T_robot_sensor);

}  // namespace cca
