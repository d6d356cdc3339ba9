// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// A world of wall segments and a laser in it: exact ranges, Gaussian noise, +inf for no return.
struct SegmentWorld {
  struct Wall {
    Eigen::Vector2d from, to;
  };
  std::vector<Wall> walls;

  void box(double x0, double y0, double x1, double y1) {
    walls.push_back({{x0, y0}, {x1, y0}});
    walls.push_back({{x1, y0}, {x1, y1}});
    walls.push_back({{x1, y1}, {x0, y1}});
    walls.push_back({{x0, y1}, {x0, y0}});
  }

  double range(const Eigen::Vector2d& origin, const Eigen::Vector2d& ray, double longest) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls) {
      const Eigen::Vector2d d = wall.to - wall.from, w = wall.from - origin;
      const double det = ray.x() * d.y() - ray.y() * d.x();
      if (det == 0.0) continue;
      const double t = (w.x() * d.y() - w.y() * d.x()) / det;
      const double s = (w.x() * ray.y() - w.y() * ray.x()) / det;
      if (t > 0.0 && t <= longest && s >= 0.0 && s <= 1.0 && t < nearest) nearest = t;
    }
    return nearest;
  }

  /// A full turn of `beams` from `pose`.
  Scan scan(const Pose2& pose, double sigma, std::mt19937& random, int beams = 360,
            double longest = 15.0) const {
    std::normal_distribution<double> noise(0.0, 1.0);
    Scan s;
    s.angle_min = -M_PI;
    s.angle_increment = 2.0 * M_PI / beams;
    s.free_range_without_return = longest;
    s.T_map_sensor = pose;
    for (int i = 0; i < beams; ++i) {
      const double bearing = pose.theta + s.bearing(static_cast<std::size_t>(i));
      const double r = range(pose.position(), {std::cos(bearing), std::sin(bearing)}, longest);
      s.ranges.push_back(std::isfinite(r) ? std::max(0.02, r + sigma * noise(random)) : r);
    }
    return s;
  }

  /// Distance of a point from the nearest wall, m.
  double distance(const Eigen::Vector2d& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls) {
      const Eigen::Vector2d d = wall.to - wall.from;
      const double t = std::min(1.0, std::max(0.0, d.dot(p - wall.from) / d.squaredNorm()));
      nearest = std::min(nearest, (wall.from + t * d - p).norm());
    }
    return nearest;
  }
};

}  // namespace cca
