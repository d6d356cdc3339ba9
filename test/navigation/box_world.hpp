// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "cca_mrpt/motion/robot.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca::testing {

/// A scan whose returns are off by noise. @param sigma  m, of their ranges.
inline Scan noisy(Scan scan, double sigma, std::mt19937& generator) {
  std::normal_distribution<double> noise(0.0, sigma);
  for (double& range : scan.ranges) {
    if (isReturn(range)) range += noise(generator);
  }
  return scan;
}

/// An axis-aligned box, m.
struct Box {
  Eigen::Vector2d low, high;

  double distance(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d outside = (low - p).cwiseMax(p - high).cwiseMax(Eigen::Vector2d::Zero());
    return outside.norm();
  }

  /// @return the ray parameter where the ray enters, or +inf. The origin lies outside.
  double enter(const Eigen::Vector2d& from, const Eigen::Vector2d& direction) const {
    double first = 0.0, last = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 2; ++axis) {
      if (direction[axis] == 0.0) {
        if (from[axis] < low[axis] || from[axis] > high[axis]) return last = INFINITY;
        continue;
      }
      double a = (low[axis] - from[axis]) / direction[axis];
      double b = (high[axis] - from[axis]) / direction[axis];
      if (a > b) std::swap(a, b);
      first = std::max(first, a);
      last = std::min(last, b);
    }
    return first <= last ? first : INFINITY;
  }
};

/// A round person, m.
struct Disc {
  Eigen::Vector2d center;
  double radius;

  double distance(const Eigen::Vector2d& p) const {
    return std::max(0.0, (p - center).norm() - radius);
  }

  double enter(const Eigen::Vector2d& from, const Eigen::Vector2d& direction) const {
    const Eigen::Vector2d to = center - from;
    const double ahead = to.dot(direction);
    const double inside = radius * radius - (to.squaredNorm() - ahead * ahead);
    if (to.norm() <= radius) return 0.0;
    return ahead > 0.0 && inside >= 0.0 ? ahead - std::sqrt(inside) : INFINITY;
  }
};

/// An exact world of boxes, with its laser: the truth that the planner is held against.
struct BoxWorld {
  std::vector<Box> boxes;
  std::vector<Disc> discs;  ///< not counted in clearance(): they move

  void add(double x1, double y1, double x2, double y2) {
    boxes.push_back({{std::min(x1, x2), std::min(y1, y2)}, {std::max(x1, x2), std::max(y1, y2)}});
  }

  /// Four walls of 0.1 m around [0, width] x [0, height].
  void addFrame(double width, double height) {
    add(-0.1, -0.1, width + 0.1, 0.0);
    add(-0.1, height, width + 0.1, height + 0.1);
    add(-0.1, 0.0, 0.0, height);
    add(width, 0.0, width + 0.1, height);
  }

  double clearance(const Eigen::Vector2d& p) const {
    double least = INFINITY;
    for (const Box& box : boxes) least = std::min(least, box.distance(p));
    return least;
  }

  Scan scan(const Pose2& T_map_sensor, double range, int beams = 361,
            double field_of_view = 2.0 * M_PI) const {
    Scan scan;
    scan.T_map_sensor = T_map_sensor;
    scan.angle_min = -0.5 * field_of_view;
    scan.angle_increment = field_of_view / (beams - 1);
    scan.free_range_without_return = range;
    for (int i = 0; i < beams; ++i) {
      const double angle = T_map_sensor.theta + scan.bearing(i);
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      double hit = INFINITY;
      for (const Box& box : boxes) {
        hit = std::min(hit, box.enter(T_map_sensor.position(), direction));
      }
      for (const Disc& disc : discs) {
        hit = std::min(hit, disc.enter(T_map_sensor.position(), direction));
      }
      scan.ranges.push_back(hit <= range ? std::max(hit, 1e-6) : INFINITY);
    }
    return scan;
  }
};

/// The differential drive: follows a command within its accelerations, exactly.
inline void drive(const Velocity& command, const RobotParameters& robot, double duration,
                  Pose2& pose, Velocity& velocity) {
  constexpr int kPieces = 10;
  const double dt = duration / kPieces;
  const auto towards = [](double from, double to, double step) {
    return from < to ? std::min(to, from + step) : std::max(to, from - step);
  };
  for (int i = 0; i < kPieces; ++i) {
    velocity.linear = towards(velocity.linear, command.linear, robot.max_linear_acceleration * dt);
    velocity.angular =
        towards(velocity.angular, command.angular, robot.max_angular_acceleration * dt);
    const double heading = pose.theta + 0.5 * velocity.angular * dt;
    pose.x += velocity.linear * std::cos(heading) * dt;
    pose.y += velocity.linear * std::sin(heading) * dt;
    pose.theta = wrapAngle(pose.theta + velocity.angular * dt);
  }
}

}  // namespace cca::testing
