// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "cca_mrpt/navigation/place/cell.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// The number of the beam at a bearing (rad, sensor frame), as a fraction in [-0.5, turn - 0.5)
/// with `turn` the beams of a full one; past the last beam it lies outside the scan.
/// Precondition: angle_increment is not 0.
inline double beamAt(double bearing, double angle_min, double angle_increment) {
  const double turn = 2.0 * M_PI / std::abs(angle_increment);
  const double beam = std::fmod((bearing - angle_min) / angle_increment, turn);
  return beam < -0.5 ? beam + turn : beam;
}

/// Unit vectors all around, counter-clockwise, `first` (rad) the bearing of the first one.
inline std::vector<Eigen::Vector2d> directionsAround(int count, double first) {
  std::vector<Eigen::Vector2d> directions;
  for (int k = 0; k < count; ++k) {
    const double bearing = first + 2.0 * M_PI * k / count;
    directions.emplace_back(std::cos(bearing), std::sin(bearing));
  }
  return directions;
}

/// Unit vector of a beam, map frame.
inline Eigen::Vector2d directionOf(const Scan& scan, std::size_t beam) {
  const double angle = scan.T_map_sensor.theta + scan.bearing(beam);
  return {std::cos(angle), std::sin(angle)};
}

/// m, map frame: where a beam's return lies. Precondition: it has one.
inline Eigen::Vector2d returnOf(const Scan& scan, std::size_t beam) {
  return scan.T_map_sensor.position() + scan.ranges[beam] * directionOf(scan, beam);
}

/// Whether the last beam of a scan is a neighbour of the first.
inline bool seesAllAround(const Scan& scan) {
  const double spacing = std::abs(scan.angle_increment);
  return static_cast<double>(scan.size()) * spacing > 2.0 * M_PI - 1.5 * spacing;
}

/// Brings points from one frame into another as Pose2 does, with its sine and cosine taken once.
inline auto transformBy(const Pose2& T) {
  return [x = T.x, y = T.y, c = std::cos(T.theta),
          s = std::sin(T.theta)](const Eigen::Vector2d& p) -> Eigen::Vector2d {
    return {x + c * p.x() - s * p.y(), y + s * p.x() + c * p.y()};
  };
}

/// The beam of a scan next to the direction of a point (m, sensor frame); it may lie outside the
/// scan, see beamAt().
inline int beamTowards(const Scan& scan, const Eigen::Vector2d& p_sensor) {
  return static_cast<int>(std::lround(
      beamAt(std::atan2(p_sensor.y(), p_sensor.x()), scan.angle_min, scan.angle_increment)));
}

/// Visits the cells that a straight line crosses, in order [Amanatides & Woo 1987].
///
/// @param origin     start, in cells (metres / resolution).
/// @param direction  unit vector.
/// @param length     in cells; the visit ends with the last cell entered before it.
/// @param visit      bool(Cell, double entered): false ends the visit. `entered`: the distance from
///                   the origin, in cells, at which the line enters the cell (0 for the first).
/// Cost: O(length).
template <class Visit>
void walkBeam(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double length,
              Visit&& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  Cell c = cellAt(origin);
  const int step_x = direction.x() > 0.0 ? 1 : -1, step_y = direction.y() > 0.0 ? 1 : -1;
  const double spacing_x = direction.x() != 0.0 ? std::abs(1.0 / direction.x()) : kNever;
  const double spacing_y = direction.y() != 0.0 ? std::abs(1.0 / direction.y()) : kNever;
  double next_x = kNever, next_y = kNever;
  if (spacing_x < kNever)
    next_x = (direction.x() > 0.0 ? c.x + 1 - origin.x() : origin.x() - c.x) * spacing_x;
  if (spacing_y < kNever)
    next_y = (direction.y() > 0.0 ? c.y + 1 - origin.y() : origin.y() - c.y) * spacing_y;
  double entered = 0.0;
  while (entered <= length && visit(c, entered)) {
    if (next_x < next_y) {
      entered = next_x;
      next_x += spacing_x;
      c.x += step_x;
    } else {
      entered = next_y;
      next_y += spacing_y;
      c.y += step_y;
    }
  }
}

}  // namespace cca
