// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// A room without furniture around the sensor: vertices counter-clockwise, the sensor inside.
struct PolygonRoom {
  std::vector<Eigen::Vector2d> vertices;

  /// Range of the ray from the origin, +inf where no edge answers.
  double range(double bearing) const {
    const Eigen::Vector2d u(std::cos(bearing), std::sin(bearing));
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const Eigen::Vector2d& a = vertices[k];
      const Eigen::Vector2d d = vertices[(k + 1) % vertices.size()] - a;
      const double den = u.x() * d.y() - u.y() * d.x();
      if (std::abs(den) < 1e-12) continue;
      const double r = (a.x() * d.y() - a.y() * d.x()) / den;
      const double t = (a.x() * u.y() - a.y() * u.x()) / den;
      if (r > 0.0 && t >= 0.0 && t <= 1.0) nearest = std::min(nearest, r);
    }
    return nearest;
  }
};

inline PolygonRoom rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

inline Scan scanOf(const PolygonRoom& room, double first_bearing, double increment, int beams,
                   double sigma, std::mt19937* random) {
  Scan scan;
  scan.angle_min = first_bearing;
  scan.angle_increment = increment;
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int i = 0; i < beams; ++i) {
    const double deviation = sigma > 0.0 ? sigma * noise(*random) : 0.0;
    scan.ranges.push_back(room.range(scan.bearing(static_cast<std::size_t>(i))) + deviation);
  }
  return scan;
}

/// A full turn, 360 beams.
inline Scan turnIn(const PolygonRoom& room, double sigma, std::mt19937* random,
                   double first_bearing = -M_PI) {
  return scanOf(room, first_bearing, 2.0 * M_PI / 360.0, 360, sigma, random);
}

}  // namespace cca
