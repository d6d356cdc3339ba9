// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "cca_mrpt/mapping/map_line.hpp"
#include "geometry/cross.hpp"
#include "mapping/map_noise.hpp"
#include "mapping/support_profile.hpp"
#include "mapping/wall_index.hpp"
#include "sensing/gates.hpp"

namespace cca {

/// A straight wall: a frame near it, and what the laser said along it. The map's lines are the
/// pieces of walls that are occupied.
struct Wall {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();      ///< m, map frame
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< unit; the viewer was on the left
  bool two_sided = false;  ///< seen from both sides, too thin to tell its faces apart
  SupportProfile profile;
  LateralFit fit;
  double visits = 0.0;          ///< new lines that it took in, bounded
  std::vector<MapLine> pieces;  ///< its occupied stretches
  /// Of the offset [m] at known_at [m along] and the direction [rad], what all scans of it share
  /// (see WallNetwork).
  Eigen::Matrix2d pose_covariance = Eigen::Matrix2d::Zero();
  double known_at = 0.0;

  std::vector<WallIndex::Cell> cells;  ///< where the index names this wall
  BinRange indexed;                    ///< the bins that those cells reach
  double hits = 0.0;                   ///< returns ever taken in
  double hits_at_check = 0.0;          ///< the same when it was last compared with its neighbours
  int length_at_check = 0;             ///< bins
  double uncut_residual = 0.0;         ///< m^2, below which no cut is worth its price
  std::uint64_t visit = 0;             ///< Walls::nextVisit() when it was last collected
  bool alive = false, touched = false;

  Eigen::Vector2d normal() const { return {-direction.y(), direction.x()}; }
  /// (t, d) of a point of the map frame.
  Eigen::Vector2d toWall(const Eigen::Vector2d& p_map) const {
    const Eigen::Vector2d v = p_map - origin;
    return {direction.dot(v), cross(direction, v)};
  }
  Eigen::Vector2d toMap(const Eigen::Vector2d& td) const {
    return origin + td.x() * direction + td.y() * normal();
  }
  /// The point of the fitted line at t.
  Eigen::Vector2d onLine(double t) const { return toMap({t, fit.at(t)}); }
  /// Unit vector of the fitted line in the map frame.
  Eigen::Vector2d fittedDirection() const;
  /// True where the bin beside the point holds hits.
  bool hitNear(const Eigen::Vector2d& p_map) const {
    const int i = SupportProfile::binOf(toWall(p_map).x());
    return profile.contains(i) && profile.bin(i).hits() > 0.0;
  }
  /// Signed distance of (t, d) from the fitted line, m.
  double offLine(const Eigen::Vector2d& td) const { return td.y() - fit.at(td.x()); }
};

/// The stretch of a wall's frame that the bins of a wall cover.
struct Extent {
  double first = 0.0, last = 0.0;  ///< m
  double length() const { return last - first; }
};

inline Extent extentOf(const Wall& wall) {
  return {wall.profile.first() * SupportProfile::kBinLength,
          wall.profile.last() * SupportProfile::kBinLength};
}

/// The same in another wall's frame.
inline Extent extentOf(const Wall& other, const Wall& frame) {
  const Extent e = extentOf(other);
  const double a = frame.toWall(other.toMap({e.first, 0.0})).x();
  const double b = frame.toWall(other.toMap({e.last, 0.0})).x();
  return {std::min(a, b), std::max(a, b)};
}

/// A wall does not grow beyond this [m], so that the work on a wall is bounded; what goes on behind
/// it is another wall.
inline constexpr double kLongestWall = 20.0;

/// rad, deviation. Where a direction errs by more than 45 degrees, along is not told from across:
/// what may do so is no line, neither of a scan that founds a wall nor a piece of one. By the
/// significance of all gates, whatever the noise: some 0.1 m at 1 cm, 0.5 m at 10 cm.
inline constexpr double kDirectionKnown = M_PI_4 / kNormalGate;

/// Adds the other wall's bins, turned into this wall's frame.
void absorb(Wall& wall, const Wall& other);
/// Moves bins of `lesser` over to `greater`: those that `yields` says, by the bin of `greater` that
/// they lie at and their distance [m] from its line. True where something moved.
bool yieldBins(Wall& lesser, Wall& greater, const std::function<bool(int, double)>& yields);
/// The other wall's bin sums in this wall's frame.
PointSums sumsInFrameOf(const Wall& wall, const Wall& other);
/// Fits the line, and moves the frame onto it where the two have drifted apart.
void refit(Wall& wall);
/// Renews `pieces`: stretches whose direction is known, of as many returns as pay for a line. A
/// piece keeps the id of the old piece that it covers most, others take new ones.
/// @param line_price  nats; a return on a line saves one, see linePrice().
void recut(Wall& wall, const MapNoise& noise, double line_price, std::uint64_t& next_id);

}  // namespace cca
