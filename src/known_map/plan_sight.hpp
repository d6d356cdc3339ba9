// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "known_map/plan_lines.hpp"
#include "slam/scan_surface.hpp"

namespace cca {

/// What the plan says of one beam at a pose.
enum class Sight {
  kExplained,  ///< ends on a line of the plan
  kHidden,     ///< ends before one, on what the plan does not show: furniture, people
  kThrough,    ///< has gone through a line: the plan, or the pose, is wrong there
  kSilent,     ///< did not return, and has gone through no line
};

/// How often each was, and how far what is explained lies from its lines.
struct SightShares {
  double explained = 0.0, hidden = 0.0, through = 0.0;
  double distance_sq = 0.0;  ///< m^2, sum over the explained

  double count() const { return explained + hidden + through; }
  /// explained / (explained + through): what SLAM calls agreement; 1 where both are 0.
  double agreement() const;
  SightShares& operator+=(const SightShares& other);
};

/// A beam to be asked about, sensor frame.
struct SightRay {
  Eigen::Vector2d end;                               ///< m
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< of the surface there; zero: unknown
  bool is_return = true;
};

/// Of a scan: returns kRaySpacing apart, so that near surfaces do not drown the others, and every
/// few degrees a beam without return, as far as it saw.
std::vector<SightRay> sightRays(const ScanSurface& surface);
inline constexpr double kRaySpacing = 0.25;  // m: so much of a wall is one word, near or far

/// What a plan says of such beams at a pose.
/// @param tolerance  m, of what is explained; see sightTolerance().
/// @param is_open    see PlanLines::crossed().
/// @param each       called with each ray, what it is, and the piece that says so (-1: none).
/// Cost: O(rays x cells of the index that each crosses).
template <class Each>
SightShares seePlan(const std::vector<SightRay>& rays, const Pose2& T_map_sensor,
                    const PlanLines& plan, double tolerance, const std::vector<bool>& is_open,
                    Each&& each);
SightShares seePlan(const std::vector<SightRay>& rays, const Pose2& T_map_sensor,
                    const PlanLines& plan, double tolerance);

/// m: of returns with this noise.
double sightTolerance(double range_sigma);

/// How much more likely a scan is that has these shares at the right pose than at one taken at
/// random, in nats a beam. What is usual at right poses is learned while the robot is localised:
/// among much furniture, hidden beams say nothing.
class SightModel {
 public:
  /// nats a beam; 0 for none.
  double evidence(const SightShares& seen) const;
  /// The same with the distances: that of a match to the millimetre speaks for itself.
  /// @param sigma  m, of the distances at the right pose. @param tolerance  m.
  double evidence(const SightShares& seen, double sigma, double tolerance) const;

  /// Of a scan that is localised.
  void learn(const SightShares& seen, double share);
  const SightShares& usual() const { return usual_; }

 private:
  /// Of rooms that are furnished and of a plan that is true but for a door.
  SightShares usual_{0.55, 0.40, 0.05, 0.0};
};

// ---------------------------------------------------------------------------------------------

inline constexpr double kBehindPlan = 0.25;  // m, behind a line, and a ray has gone through

template <class Each>
SightShares seePlan(const std::vector<SightRay>& rays, const Pose2& T_map_sensor,
                    const PlanLines& plan, double tolerance, const std::vector<bool>& is_open,
                    Each&& each) {
  SightShares shares;
  const double c = std::cos(T_map_sensor.theta), s = std::sin(T_map_sensor.theta);
  const Eigen::Vector2d origin = T_map_sensor.position();
  for (const SightRay& ray : rays) {
    const Eigen::Vector2d end{origin.x() + c * ray.end.x() - s * ray.end.y(),
                              origin.y() + s * ray.end.x() + c * ray.end.y()};
    PlanLines::Slot slot = plan.crossed(origin, end, kBehindPlan, is_open);
    if (slot >= 0) {
      shares.through += 1.0;
      each(ray, Sight::kThrough, slot);
      continue;
    }
    if (!ray.is_return) {
      each(ray, Sight::kSilent, -1);
      continue;
    }
    const Eigen::Vector2d normal{c * ray.normal.x() - s * ray.normal.y(),
                                 s * ray.normal.x() + c * ray.normal.y()};
    slot = plan.nearest(end, normal, tolerance);
    if (slot >= 0) {
      const double apart = PlanLines::distance(plan[slot], end);
      shares.explained += 1.0;
      shares.distance_sq += apart * apart;
      each(ray, Sight::kExplained, slot);
    } else {
      shares.hidden += 1.0;
      each(ray, Sight::kHidden, -1);
    }
  }
  return shares;
}

}  // namespace cca
