// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "cca_mrpt/mapping/line_segment.hpp"
#include "cca_mrpt/mapping/support_profile.hpp"
#include "cca_mrpt/mapping/wall_index.hpp"

namespace cca {

/// One segment of the map, in the map frame.
struct MapLine {
  std::uint64_t id = 0;  ///< stable while the line exists
  LineSegment segment;   ///< from start to end the side it was seen from lies on the left
  double support = 0.0;  ///< number of laser returns that it stands on
};

/// A straight wall: a frame near it, and what the laser said along it. The map's lines are the
/// pieces of walls that are occupied.
struct Wall {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();      ///< m, map frame
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< unit; the viewer was on the left
  bool two_sided = false;  ///< seen from both sides, too thin to tell its faces apart
  SupportProfile profile;
  LateralFit fit;
  std::vector<BinRange> ranges;  ///< what of the profile is occupied
  std::vector<MapLine> pieces;   ///< the same as segments; parallel to `ranges`

  std::vector<WallIndex::Cell> cells;  ///< where the index names this wall
  BinRange indexed;                    ///< the bins that those cells cover
  double hits_at_check = 0.0;          ///< returns when it was last compared with its neighbours
  double hits = 0.0;
  std::uint64_t stamp = 0;
  std::uint64_t ray_stamp = 0;
  bool alive = false;

  Eigen::Vector2d normal() const { return {-direction.y(), direction.x()}; }
  /// (t, d) of a point of the map frame.
  Eigen::Vector2d toWall(const Eigen::Vector2d& p_map) const {
    const Eigen::Vector2d v = p_map - origin;
    return {direction.dot(v), direction.x() * v.y() - direction.y() * v.x()};
  }
  Eigen::Vector2d toMap(double t, double d) const { return origin + t * direction + d * normal(); }
  /// Unit vector of the fitted line in the map frame.
  Eigen::Vector2d fittedDirection() const;
  /// Lateral distance of (t, d) from the fitted line.
  double offLine(const Eigen::Vector2d& td) const { return td.y() - fit.at(td.x()); }
};

/// Adds the other wall's bins, turned into this wall's frame.
void absorb(Wall& wall, const Wall& other);
/// The other wall's bin sums in this wall's frame.
BinSums sumsInFrameOf(const Wall& wall, const Wall& other);
/// Moves the frame onto the fitted line where it has drifted from it by more than `tolerance` [m].
void reanchor(Wall& wall, double tolerance);

}  // namespace cca
