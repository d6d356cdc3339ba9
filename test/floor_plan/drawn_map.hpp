// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "cca_mrpt/geometry/polygon.hpp"
#include "cca_mrpt/geometry/pose2.hpp"
#include "mapping/wall.hpp"

namespace cca {

/// A finished map of a building whose truth is known.
struct DrawnMap {
  OccupancyRaster grid;
  std::vector<MapLine> lines;
};

inline double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                const Eigen::Vector2d& b) {
  const Eigen::Vector2d way = b - a;
  const double t = std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (a + t * way - p).norm();
}

/// What a robot that has been everywhere would bring home.
/// @param rings     borders of the free space, it on their left: outlines and holes.
/// @param T         where the building lies: at any angle, off the grid's lines.
/// @param shortest  m; shorter sides have cells, and no line.
/// @param noise     m, sigma of the ends of lines across them.
inline DrawnMap drawMap(const std::vector<Polygon>& rings, const Pose2& T, double shortest = 0.25,
                        double noise = 0.0) {
  DrawnMap map;
  std::mt19937 random(7);  // seeded
  std::normal_distribution<double> gauss(0.0, 1.0);
  std::vector<Polygon> placed;
  Eigen::AlignedBox2d box;
  for (const Polygon& ring : rings) {
    placed.emplace_back();
    for (const auto& p : ring) placed.back().push_back(T * p);
    box.extend(boundsOf(placed.back()));
  }
  for (const Polygon& ring : placed) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Eigen::Vector2d a = ring[k], b = ring[(k + 1) % ring.size()];
      if ((b - a).norm() < shortest) continue;
      const Eigen::Vector2d across = Eigen::Vector2d(a.y() - b.y(), b.x() - a.x()).normalized();
      MapLine line;
      line.id = map.lines.size() + 1;
      line.segment.start = a + noise * gauss(random) * across;
      line.segment.end = b + noise * gauss(random) * across;
      map.lines.push_back(line);
    }
  }
  OccupancyRaster& grid = map.grid;
  grid.origin = box.min() - Eigen::Vector2d(0.5, 0.5);
  grid.columns = static_cast<int>((box.sizes().x() + 1.0) / grid.resolution);
  grid.rows = static_cast<int>((box.sizes().y() + 1.0) / grid.resolution);
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 0; x < grid.columns; ++x) {
      const Eigen::Vector2d p = grid.centreOf({x, y});
      bool is_free = false;
      double nearest = 1e9;
      for (const Polygon& ring : placed) {
        if (isInside(ring, p)) is_free = !is_free;
        for (std::size_t k = 0; k < ring.size(); ++k)
          nearest = std::min(nearest, distanceToSegment(p, ring[k], ring[(k + 1) % ring.size()]));
      }
      grid.values.push_back(is_free                           ? Occupancy::kFree
                            : nearest < 1.5 * grid.resolution ? Occupancy::kOccupied
                                                              : Occupancy::kUnknown);
    }
  }
  return map;
}

/// Two rooms of 5 x 4 m and 3 x 4 m beside each other, a wall of 0.12 m, a door of 0.9 m in it.
inline Polygon twoRooms() {
  return {{0, 0},    {5, 0},    {5, 1.5},    {5.12, 1.5}, {5.12, 0}, {8.12, 0},
          {8.12, 4}, {5.12, 4}, {5.12, 2.4}, {5, 2.4},    {5, 4},    {0, 4}};
}

}  // namespace cca
