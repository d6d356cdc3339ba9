// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

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

/// Whether a beam of a scan, or the next one beside it, goes where a place (m, map frame) lies,
/// however far.
bool looksTowards(const Scan& scan, const Eigen::Vector2d& p_map);

/// The sectors of the plane, map frame, into which a scan looks: a bit each of 32 around, the first
/// from the x axis on counter-clockwise. None where it has no beam, or is not finite.
std::uint32_t sectorsInView(const Scan& scan);

}  // namespace cca
