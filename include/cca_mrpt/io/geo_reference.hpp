// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

namespace cca {

/// Where on the Earth (WGS 84) the map frame lies.
struct GeoReference {
  double latitude_deg = 0.0, longitude_deg = 0.0;  ///< of the map's (0, 0)
  double turn_deg = 0.0;  ///< of the map's x axis from east, counter-clockwise: 0: y is north

  /// (longitude, latitude) [deg] of a point of the map frame [m], on the plane that touches the
  /// ellipsoid at the origin.
  Eigen::Vector2d toDegrees(const Eigen::Vector2d& p_map) const;
  /// The inverse; within a kilometre to .1 mm.
  Eigen::Vector2d toMap(const Eigen::Vector2d& longitude_latitude_deg) const;

  /// Whether the latitude is in [-89.9, 89.9], the longitude in [-180, 180], the turn in
  /// [-360, 360]; false of what is no number.
  bool isOnEarth() const {
    return std::abs(latitude_deg) <= 89.9 && std::abs(longitude_deg) <= 180.0 &&
           std::abs(turn_deg) <= 360.0;
  }
};

/// Reads "LAT,LON" or "LAT,LON,DEG", degrees.
/// @throws std::runtime_error naming what is no number or out of range: latitude in [-89.9, 89.9],
///         longitude in [-180, 180], turn in [-360, 360].
GeoReference geoReferenceOf(const std::string& text);

}  // namespace cca
