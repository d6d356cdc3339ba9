// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "cca_mrpt/mapping/line_map.hpp"
#include "segment_world.hpp"

namespace cca {

/// Points every 5 cm along the lines of the map.
inline std::vector<Eigen::Vector2d> pointsOn(const std::vector<MapLine>& lines) {
  std::vector<Eigen::Vector2d> points;
  for (const MapLine& line : lines) {
    const LineSegment& s = line.segment;
    const int n = 1 + static_cast<int>(s.length() / 0.05);
    for (int i = 0; i <= n; ++i) points.push_back(s.start + (s.end - s.start) * i / double(n));
  }
  return points;
}

/// Share of the world's wall length within `gate` of a map line.
inline double recall(const SegmentWorld& world, const std::vector<MapLine>& lines, double gate) {
  SegmentWorld map;
  for (const MapLine& line : lines) map.walls.push_back({line.segment.start, line.segment.end});
  int found = 0, all = 0;
  for (const SegmentWorld::Wall& wall : world.walls) {
    const int n = static_cast<int>((wall.to - wall.from).norm() / 0.05);
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector2d p = wall.from + (wall.to - wall.from) * ((i + 0.5) / n);
      found += !map.walls.empty() && map.distance(p) <= gate ? 1 : 0;
      ++all;
    }
  }
  return double(found) / all;
}

inline double precision(const SegmentWorld& world, const std::vector<MapLine>& lines, double gate) {
  int near = 0;
  const auto points = pointsOn(lines);
  for (const Eigen::Vector2d& p : points) near += world.distance(p) <= gate ? 1 : 0;
  return points.empty() ? 0.0 : double(near) / double(points.size());
}

/// Drives a circle of `radius` around (x, y) with `steps` scans.
inline void drive(LineMap& map, const SegmentWorld& world, std::mt19937& random,
                  double sigma = 0.01, int steps = 40, double radius = 1.0, double jitter = 0.0) {
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int i = 0; i < steps; ++i) {
    const double a = 2.0 * M_PI * i / steps;
    const Pose2 pose{radius * std::cos(a), radius * std::sin(a), a};
    Scan scan = world.scan(pose, sigma, random);
    scan.T_map_sensor.x += jitter * noise(random);
    scan.T_map_sensor.y += jitter * noise(random);
    map.insert(scan);
  }
}

inline SegmentWorld room() {
  SegmentWorld world;
  world.box(-4.0, -3.0, 4.0, 3.0);
  return world;
}

}  // namespace cca
