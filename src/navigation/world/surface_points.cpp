// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/world/surface_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/cross.hpp"
#include "sensing/beam.hpp"

namespace cca {
namespace {

constexpr double kSteepest = 4.0;  // widest gap in one surface, in spacings of the beams
// Of a gap, from it to a third return in line. A return from around a corner, close by, is in line
// with anything: it would wall up doorways.
constexpr double kLeastReach = 0.2, kMostReach = 4.0;
constexpr double kInLine = 0.03;   // m, three deviations of 1 cm; it grows with that
constexpr double kBaseline = 2.0;  // cells: ten deviations of 1 cm, and a corner is rounded by them

using Points = std::vector<SurfacePoint>;

/// Whether the returns of beam i and the next one lie on one surface.
bool isOneSurface(const Points& points, std::size_t i, double spacing, double tolerance) {
  const std::size_t n = points.size();
  const SurfacePoint &a = points[i], &b = points[(i + 1) % n];
  if (!a.is_return || !b.is_return) return false;
  const double gap = (b.place - a.place).norm();
  if (gap <= std::max(1.0, kSteepest * spacing)) return true;
  const Eigen::Vector2d along = (b.place - a.place) / gap;
  const auto isInLine = [&](const SurfacePoint& third, const SurfacePoint& end) {
    if (!third.is_return) return false;
    const Eigen::Vector2d offset = third.place - end.place;
    const double reach = std::abs(offset.dot(along)) / gap;
    return reach > kLeastReach && reach < kMostReach &&
           std::abs(cross(along, offset)) < tolerance * (1.0 + reach);
  };
  return isInLine(points[(i + n - 1) % n], a) || isInLine(points[(i + 2) % n], b);
}

/// Unit vector square to the surface at the return of beam i, away from the sensor; zero where
/// nothing tells.
Eigen::Vector2d awayFromSensor(const Points& points, std::size_t i, const Eigen::Vector2d& beam) {
  const std::size_t n = points.size();
  std::size_t first = i, last = i;
  const auto isNear = [&](std::size_t k) {
    return (points[k].place - points[i].place).norm() < kBaseline;
  };
  for (std::size_t steps = 0; steps < n && isNear(first); ++steps) {
    const std::size_t before = (first + n - 1) % n;
    if (!points[before].goes_on) break;
    first = before;
  }
  for (std::size_t steps = 0; steps < n && isNear(last) && points[last].goes_on; ++steps)
    last = (last + 1) % n;
  const Eigen::Vector2d along = points[last].place - points[first].place;
  const double length = along.norm();
  if (length == 0.0) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d square = Eigen::Vector2d(-along.y(), along.x()) / length;
  return square.dot(beam) < 0.0 ? Eigen::Vector2d(-square) : square;
}

}  // namespace

std::vector<SurfacePoint> surfacePoints(const Scan& scan,
                                        const std::vector<Eigen::Vector2d>& directions,
                                        double resolution, double depth, double farthest) {
  const std::size_t n = scan.size();
  const Eigen::Vector2d origin = scan.T_map_sensor.position() / resolution;
  Points points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double range = scan.ranges[i] / resolution;
    points[i].is_return = isReturn(range) && range <= farthest;
    if (points[i].is_return) points[i].place = origin + range * directions[i];
  }
  const std::size_t ends = n > 0 && !seesAllAround(scan) ? 1 : 0;
  for (std::size_t i = 0; i + ends < n; ++i) {
    const double nearer = std::min(scan.ranges[i], scan.ranges[(i + 1) % n]) / resolution;
    points[i].goes_on =
        isOneSurface(points, i, nearer * std::abs(scan.angle_increment), kInLine / resolution);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!points[i].is_return) continue;
    const Eigen::Vector2d away = awayFromSensor(points, i, directions[i]);
    points[i].squareness = away.dot(directions[i]);
    points[i].inside = points[i].place + depth * (away.isZero() ? directions[i] : away);
  }
  return points;
}

}  // namespace cca
