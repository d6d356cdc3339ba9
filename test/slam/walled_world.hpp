// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"
#include "geometry/cross.hpp"

namespace cca::test {

/// Walls between pairs of points, seen by a laser without noise but for what is asked for.
class WalledWorld {
 public:
  void addWall(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { walls_.emplace_back(a, b); }
  void addBox(double x0, double y0, double x1, double y1) {
    addWall({x0, y0}, {x1, y0});
    addWall({x1, y0}, {x1, y1});
    addWall({x1, y1}, {x0, y1});
    addWall({x0, y1}, {x0, y0});
  }

  const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& walls() const { return walls_; }

  Scan scan(const Pose2& T_map_sensor, int beams, double field_of_view, double sigma = 0.0,
            double longest = 20.0) {
    Scan scan;
    scan.angle_min = -0.5 * field_of_view;
    scan.angle_increment = field_of_view / (beams - (field_of_view > 6.2 ? 0 : 1));
    scan.free_range_without_return = longest;
    for (int k = 0; k < beams; ++k) {
      const double angle = T_map_sensor.theta + scan.bearing(static_cast<std::size_t>(k));
      const double range =
          cast(T_map_sensor.position(), {std::cos(angle), std::sin(angle)}) + sigma * noise();
      scan.ranges.push_back(range < longest ? range : HUGE_VAL);
    }
    return scan;
  }

  /// Standard normal, nearly: twelve uniform ones.
  double noise() {
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) {
      state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
      sum += static_cast<double>(state_ >> 11) * 0x1.0p-53;
    }
    return sum;
  }

 private:
  double cast(const Eigen::Vector2d& from, const Eigen::Vector2d& ray) const {
    double nearest = HUGE_VAL;
    for (const auto& [a, b] : walls_) {
      const Eigen::Vector2d wall = b - a;
      const double across = cross(ray, wall);
      if (std::abs(across) < 1e-12) continue;
      const double range = cross(a - from, wall) / across, along = cross(a - from, ray) / across;
      if (range > 0.0 && along >= 0.0 && along <= 1.0) nearest = std::min(nearest, range);
    }
    return nearest;
  }

  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> walls_;
  std::uint64_t state_ = 1;
};

/// A ring of corridors, 2 m wide, around a block of 16 x 12 m, with niches that tell places apart.
inline WalledWorld ringWithNiches() {
  WalledWorld world;
  world.addBox(0.0, 0.0, 20.0, 16.0);
  world.addBox(2.0, 2.0, 18.0, 14.0);
  world.addBox(4.0, 0.0, 4.6, 0.5);
  world.addBox(11.0, 1.6, 11.8, 2.0);
  world.addBox(19.4, 5.0, 20.0, 6.1);
  world.addBox(18.0, 10.2, 18.3, 11.0);
  world.addBox(13.5, 15.5, 14.6, 16.0);
  world.addBox(6.0, 14.0, 6.5, 14.4);
  world.addBox(0.0, 9.0, 0.4, 10.3);
  world.addBox(1.7, 5.0, 2.0, 5.7);
  return world;
}

/// Another building, wide and unlike on all sides, that the same way leads through.
inline WalledWorld hallWithBlocks() {
  WalledWorld world;
  world.addBox(-1.0, -3.0, 21.0, 18.0);
  world.addBox(5.0, 4.0, 13.0, 9.0);
  world.addBox(15.0, 6.0, 16.0, 13.0);
  return world;
}

/// Once around that block and on to the middle of the first side again; a pose every `step` m, and
/// 75 degrees a metre.
inline std::vector<Pose2> driveAroundRing(double step) {
  const std::vector<Eigen::Vector2d> corners{{10, 1}, {19, 1}, {19, 15}, {1, 15},
                                             {1, 1},  {19, 1}, {19, 8}};
  std::vector<Pose2> way;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const Eigen::Vector2d leg = corners[k + 1] - corners[k];
    const double heading = std::atan2(leg.y(), leg.x());
    if (!way.empty()) {
      const double turn = wrapAngle(heading - way.back().theta);
      const int turns = static_cast<int>(std::ceil(1.2 / step));
      for (int i = 1; i < turns; ++i) {
        const double left = turn * (1.0 - static_cast<double>(i) / turns);
        way.push_back({corners[k].x(), corners[k].y(), wrapAngle(heading - left)});
      }
    }
    for (double s = 0.0; s < leg.norm(); s += step) {
      const Eigen::Vector2d p = corners[k] + leg.normalized() * s;
      way.push_back({p.x(), p.y(), heading});
    }
  }
  return way;
}

/// What wheels make of a drive: each step errs by 2 % of its length and a degree a metre, and turns
/// short.
inline std::vector<Pose2> wheelsOf(const std::vector<Pose2>& way, WalledWorld& world) {
  std::vector<Pose2> wheels{way.front()};
  for (std::size_t k = 1; k < way.size(); ++k) {
    Pose2 step = way[k - 1].inverse() * way[k];
    const double length = step.position().norm();
    step.x *= 1.0 + 0.02 * world.noise();
    step.theta += 0.0175 * std::sqrt(length) * world.noise() + 0.01 * length + 0.02 * step.theta;
    wheels.push_back(wheels.back() * step);
  }
  return wheels;
}

}  // namespace cca::test
