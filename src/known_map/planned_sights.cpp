// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/planned_sights.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <set>
#include <utility>

#include "cca_mrpt/geometry/cell.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

/// m: some of the steps lead through a door of 0.8 m with a robot of 0.25 m radius in it.
constexpr double kFloodStep = 0.2;
constexpr int kSightBeams = 360;        // a degree apart, as those of common lasers
constexpr double kLongestSight = 20.0;  // m; farther out beams are a cell of the explorer's apart
constexpr std::size_t kMostSights = 20000;  // some 4 hectares: bounds work and memory

/// m, along a ray to a piece; infinite where it passes by.
double distanceTo(const PlanLines::Piece& piece, const Eigen::Vector2d& p_map,
                  const Eigen::Vector2d& ray) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double across = cross(ray, piece.direction);
  if (std::abs(across) < 1e-12) return kNever;
  const Eigen::Vector2d v = piece.start - p_map;
  const double range = cross(v, piece.direction) / across, along = cross(v, ray) / across;
  return range >= 0.0 && along >= 0.0 && along <= piece.length ? range : kNever;
}

Scan sightFrom(const PlanLines& plan, const Eigen::Vector2d& p_map) {
  Scan scan;
  scan.angle_min = -M_PI;
  scan.angle_increment = 2.0 * M_PI / kSightBeams;
  scan.T_map_sensor = {p_map.x(), p_map.y(), 0.0};
  for (int beam = 0; beam < kSightBeams; ++beam) {
    const double bearing = scan.bearing(static_cast<std::size_t>(beam));
    const double range = rangeInPlan(plan, p_map, bearing, kLongestSight);
    scan.ranges.push_back(std::isfinite(range) ? range : std::nan(""));
  }
  return scan;
}

bool seesEachOther(const PlanLines& plan, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d way = b - a;
  const double length = way.norm();
  return length <= 0.0 || rangeInPlan(plan, a, std::atan2(way.y(), way.x()), length) > length;
}

}  // namespace

double rangeInPlan(const PlanLines& plan, const Eigen::Vector2d& p_map, double bearing,
                   double longest) {
  const Eigen::Vector2d ray(std::cos(bearing), std::sin(bearing));
  constexpr double kSide = PlanLines::kCell;
  double nearest = std::numeric_limits<double>::infinity();
  // What is nearer than a piece that a cell knows of is near that cell as well.
  walkBeam(p_map / kSide, ray, longest / kSide, [&](Cell cell, double) {
    const Eigen::Vector2d centre = kSide * Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5);
    for (const PlanLines::Slot slot : plan.near(centre)) {
      nearest = std::min(nearest, distanceTo(plan[slot], p_map, ray));
    }
    return !std::isfinite(nearest);
  });
  return nearest <= longest ? nearest : std::numeric_limits<double>::infinity();
}

std::vector<Scan> plannedSights(const PlanLines& plan, const Eigen::Vector2d& start,
                                double clearance) {
  std::vector<Scan> sights;
  if (plan.empty()) return sights;
  const auto placeOf = [&](const std::pair<int, int>& step) {
    return Eigen::Vector2d(start + kFloodStep * Eigen::Vector2d(step.first, step.second));
  };
  const auto isInSight = [&](const Eigen::Vector2d& p) {
    return std::any_of(sights.begin(), sights.end(), [&](const Scan& sight) {
      const Eigen::Vector2d from = sight.T_map_sensor.position();
      return (from - p).norm() < kPlannedSightSpacing && seesEachOther(plan, from, p);
    });
  };
  std::set<std::pair<int, int>> reached{{0, 0}};
  std::deque<std::pair<int, int>> open{{0, 0}};
  while (!open.empty() && sights.size() < kMostSights) {
    const auto here = open.front();
    const Eigen::Vector2d p = placeOf(here);
    open.pop_front();
    if (!isInSight(p)) sights.push_back(sightFrom(plan, p));
    for (const auto& [dx, dy] :
         {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
      const std::pair<int, int> next{here.first + dx, here.second + dy};
      const Eigen::Vector2d q = placeOf(next);
      if (!plan.bounds().contains(q) || reached.count(next) > 0) continue;
      if (plan.nearest(q, Eigen::Vector2d::Zero(), clearance) >= 0) continue;
      if (!seesEachOther(plan, p, q)) continue;
      reached.insert(next);
      open.push_back(next);
    }
  }
  return sights;
}

}  // namespace cca
