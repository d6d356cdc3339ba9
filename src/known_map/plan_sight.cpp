// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/plan_sight.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "slam/likelihood_pyramid.hpp"

namespace cca {
namespace {

constexpr double kSilentSpacing = 0.07;  // rad: kRaySpacing, at a usual distance of walls, 3.6 m
constexpr double kShortOfFree = 0.3;     // m, that a silent beam is taken to have seen less
constexpr double kBehindPlan = 0.25;     // m, behind a line, and a ray has gone through

/// What the beams of a scan are at a pose that somebody guesses, in a building. Of those that go
/// through a line 24 % end at another, straight on or mirrored (780 000 of `localisation_test`).
constexpr double kExplainedByChance = 0.25, kHiddenByChance = 0.45, kThroughByChance = 0.23,
                 kBeyondByChance = 0.07;
/// What never came so far may come yet.
constexpr double kLeastShare = 0.02;

/// Whether a return behind a piece is of a line of the plan all the same: seen through it, as it is
/// of glass, or in it, as in a mirror.
bool endsAtPlanBeyond(const PlanLines::Piece& pane, const Eigen::Vector2d& end,
                      const Eigen::Vector2d& normal, const PlanLines& plan, double tolerance) {
  if (plan.nearest(end, normal, tolerance) >= 0) return true;
  const auto mirrored = [across = pane.normal()](const Eigen::Vector2d& v) {
    return Eigen::Vector2d(v - 2.0 * across.dot(v) * across);
  };
  const Eigen::Vector2d before = pane.start + mirrored(end - pane.start);
  return plan.nearest(before, mirrored(normal), tolerance) >= 0;
}

}  // namespace

double SightShares::agreement() const {
  const double told = explained + through;
  return told > 0.0 ? explained / told : 1.0;
}

SightShares& SightShares::operator+=(const SightShares& other) {
  explained += other.explained;
  hidden += other.hidden;
  through += other.through;
  beyond += other.beyond;
  distance_sq += other.distance_sq;
  return *this;
}

double sightTolerance(double range_sigma) { return std::clamp(4.0 * range_sigma, 0.1, 0.25); }

std::vector<SightRay> sightRays(const ScanSurface& surface) {
  std::vector<SurfacePoint> points;
  for (const ScanSurface::Point& point : surface.points) {
    if (point.position.norm() < kFarthestCompared) points.push_back({point.position, point.normal});
  }
  std::vector<SightRay> rays;
  for (const SurfacePoint& p : thinned(points, kRaySpacing)) {
    rays.push_back({p.position, p.normal, true});
  }
  double last = -HUGE_VAL;
  for (int beam = 0; beam < surface.beams(); ++beam) {
    const auto k = static_cast<std::size_t>(beam);
    const double bearing = surface.first_bearing + beam * surface.spacing;
    const double free = std::min(surface.free_range[k], kFarthestCompared) - kShortOfFree;
    if (surface.point_of_beam[k] >= 0 || free <= 0.0 || bearing - last < kSilentSpacing) continue;
    last = bearing;
    rays.push_back({free * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)),
                    Eigen::Vector2d::Zero(), false});
  }
  return rays;
}

SightShares seePlan(const std::vector<SightRay>& rays, const Pose2& T_map_sensor,
                    const PlanLines& plan, double tolerance, const std::vector<bool>& is_open,
                    std::vector<PieceSight>* said) {
  SightShares shares;
  const double c = std::cos(T_map_sensor.theta), s = std::sin(T_map_sensor.theta);
  const auto inMapAxes = [&](const Eigen::Vector2d& v) {
    return Eigen::Vector2d(c * v.x() - s * v.y(), s * v.x() + c * v.y());
  };
  const Eigen::Vector2d origin = T_map_sensor.position();
  for (const SightRay& ray : rays) {
    const Eigen::Vector2d end = origin + inMapAxes(ray.end), normal = inMapAxes(ray.normal);
    const PlanLines::Slot crossed = plan.crossed(origin, end, kBehindPlan, {});
    if (crossed >= 0) {
      if (said) said->push_back({crossed, true});
      const bool is_door = !is_open.empty() && is_open[static_cast<std::size_t>(crossed)];
      if (!is_door || plan.crossed(origin, end, kBehindPlan, is_open) >= 0) {
        const bool is_pane =
            ray.is_return && endsAtPlanBeyond(plan[crossed], end, normal, plan, tolerance);
        (is_pane ? shares.beyond : shares.through) += 1.0;
        continue;
      }
    }
    if (!ray.is_return) continue;
    const PlanLines::Slot on = plan.nearest(end, normal, tolerance);
    if (on < 0) {
      shares.hidden += 1.0;
      continue;
    }
    const double apart = PlanLines::distance(plan[on], end);
    shares.explained += 1.0;
    shares.distance_sq += apart * apart;
    if (said && crossed < 0) said->push_back({on, false});
  }
  return shares;
}

double SightModel::evidence(const SightShares& seen) const {
  const double count = seen.count();
  if (count <= 0.0) return 0.0;
  const double sum = seen.explained * std::log(usual_.explained / kExplainedByChance) +
                     seen.hidden * std::log(usual_.hidden / kHiddenByChance) +
                     seen.through * std::log(usual_.through / kThroughByChance) +
                     seen.beyond * std::log(usual_.beyond / kBeyondByChance);
  return sum / count;
}

double SightModel::evidence(const SightShares& seen, double sigma, double tolerance) const {
  const double count = seen.count();
  if (count <= 0.0) return 0.0;
  // Half a normal distribution over an even one, up to the tolerance.
  const double exact = seen.explained * std::log(std::sqrt(2.0 / M_PI) * tolerance / sigma) -
                       0.5 * seen.distance_sq / (sigma * sigma);
  return evidence(seen) + exact / count;
}

void SightModel::learn(const SightShares& seen, double share) {
  const double count = seen.count();
  if (count <= 0.0) return;
  const auto follow = [&](double& usual, double now) {
    usual = std::max(kLeastShare, usual + share * (now / count - usual));
  };
  follow(usual_.explained, seen.explained);
  follow(usual_.hidden, seen.hidden);
  follow(usual_.through, seen.through);
  follow(usual_.beyond, seen.beyond);
}

}  // namespace cca
