// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sensing/undistortion.hpp"

namespace cca {

struct Laser {
  double first, increment;  ///< rad
  int beams;
};

/// A room of 8 m x 6 m, turned against the axes, with two boxes in it, seen by a laser that
/// measures each beam from where it is by then.
class SweptRoom {
 public:
  SweptRoom() {
    addBox({0.0, 0.0, 0.2}, 4.0, 3.0);
    addBox({2.5, 1.3, 0.5}, 0.4, 0.3);
    addBox({-1.9, -1.2, -0.4}, 0.3, 0.5);
  }

  /// @param T_map_sensor  in the middle of the sweep. @param duration  s, see Scan.
  Scan sweep(const Laser& laser, const Pose2& T_map_sensor, const Twist& sensor,
             double duration) const {
    Scan scan;
    scan.angle_min = laser.first;
    scan.angle_increment = laser.increment;
    scan.sweep_duration = duration;
    scan.T_map_sensor = T_map_sensor;
    for (int i = 0; i < laser.beams; ++i) {
      const double time = duration * (i / (laser.beams - 1.0) - 0.5);
      const Pose2 T = T_map_sensor * moveBy(sensor, time);
      scan.ranges.push_back(range(T.position(), T.theta + laser.first + i * laser.increment));
    }
    return scan;
  }

  /// m, from the nearest wall.
  double distance(const Eigen::Vector2d& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Edge& edge : edges_) {
      const Eigen::Vector2d d = edge.b - edge.a;
      const double t = std::clamp(d.dot(p - edge.a) / d.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - edge.a - t * d).norm());
    }
    return nearest;
  }

 private:
  struct Edge {
    Eigen::Vector2d a, b;
  };
  void addBox(const Pose2& T, double half_length, double half_width) {
    const double x[] = {-1, 1, 1, -1}, y[] = {-1, -1, 1, 1};
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      edges_.push_back({T * Eigen::Vector2d(half_length * x[k], half_width * y[k]),
                        T * Eigen::Vector2d(half_length * x[next], half_width * y[next])});
    }
  }
  double range(const Eigen::Vector2d& from, double bearing) const {
    const Eigen::Vector2d u(std::cos(bearing), std::sin(bearing));
    double nearest = std::numeric_limits<double>::infinity();
    for (const Edge& edge : edges_) {
      const Eigen::Vector2d d = edge.b - edge.a, a = edge.a - from;
      const double den = u.x() * d.y() - u.y() * d.x();
      if (std::abs(den) < 1e-12) continue;
      const double r = (a.x() * d.y() - a.y() * d.x()) / den;
      const double t = (a.x() * u.y() - a.y() * u.x()) / den;
      if (r > 0.0 && t >= 0.0 && t <= 1.0) nearest = std::min(nearest, r);
    }
    return nearest;
  }

  std::vector<Edge> edges_;
};

}  // namespace cca
