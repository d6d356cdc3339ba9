// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "known_map/plan_lines.hpp"
#include "slam/scan_surface.hpp"

namespace cca {

/// What the plan says of the beams of a scan at a pose: how many are of each kind, and how far what
/// is explained lies from its lines. Beams that did not return, and have gone through no line, are
/// of none.
struct SightShares {
  double explained = 0.0;    ///< end on a line of the plan
  double hidden = 0.0;       ///< end before one, on what the plan does not show: furniture, people
  double through = 0.0;      ///< have gone through a line: the plan, or the pose, is wrong there
  double beyond = 0.0;       ///< so, but to another line: through a pane, or in a mirror
  double distance_sq = 0.0;  ///< m^2, sum over the explained

  double count() const { return explained + hidden + through + beyond; }
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

/// What a beam says of a piece of the plan: it ends there, or has gone through.
struct PieceSight {
  PlanLines::Slot slot = -1;
  bool is_through = false;
};

/// What a plan says of such beams at a pose.
/// @param tolerance  m, of what is explained; see sightTolerance().
/// @param is_open    by slot: pieces that beams may go through; empty: none.
/// @param said       what beams say of pieces, open ones as well, is added here.
/// Cost: O(rays x cells that each crosses).
SightShares seePlan(const std::vector<SightRay>& rays, const Pose2& T_map_sensor,
                    const PlanLines& plan, double tolerance, const std::vector<bool>& is_open = {},
                    std::vector<PieceSight>* said = nullptr);

/// m: of returns with this noise.
double sightTolerance(double range_sigma);

/// Beams that are kRaySpacing apart err together where they meet one thing: a wardrobe, a wall
/// that is not where the plan has it. So much of one of its own is each worth.
inline constexpr double kOwnWord = 0.5;

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
  /// Of rooms that are furnished and of a plan that is true but for a door, and perhaps a pane.
  SightShares usual_{0.55, 0.38, 0.04, 0.03, 0.0};
};

}  // namespace cca
