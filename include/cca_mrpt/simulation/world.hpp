// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca {

/// A static world in MRPT's occupancy grid. All that is not known to be free is an obstacle:
/// unknown cells, the outermost rows and columns, and everything beyond them.
///
/// Cell (ix, iy) covers origin + resolution * [ix, ix + 1) x [iy, iy + 1). MRPT keeps its grid at
/// multiples of a single-precision resolution; `origin` and `resolution` are exact, and the grid
/// itself lies at (0, 0): p_grid = p_map - origin.
class World {
 public:
  World() = default;
  /// @param obstacle    width * height cells, row by row from the lowest y; non-zero: not free.
  ///                    The outermost rows and columns become obstacles whatever is given.
  /// @param resolution  m, positive, a cell's side.
  /// @param origin      m, map frame, lower left corner of cell (0, 0).
  World(std::string name, int width, int height, const std::vector<unsigned char>& obstacle,
        double resolution, const Eigen::Vector2d& origin);

  int width() const { return width_; }
  int height() const { return height_; }
  double resolution() const { return resolution_; }
  const Eigen::Vector2d& origin() const { return origin_; }
  /// All cells are either 0 (obstacle) or 1 (free); placed at (0, 0), see above.
  const mrpt::maps::COccupancyGridMap2D& grid() const { return grid_; }

  /// Row by row from the lowest y; non-zero: obstacle.
  const std::vector<unsigned char>& obstacles() const { return cells_; }
  bool isObstacle(int ix, int iy) const {
    if (ix < 0 || iy < 0 || ix >= width_ || iy >= height_) return true;
    return cells_[static_cast<std::size_t>(iy) * width_ + ix] != 0;
  }
  /// A point in units of cells, from the grid's corner; the cell that it lies in is its floor.
  Eigen::Vector2d toCells(const Eigen::Vector2d& p_map) const {
    return (p_map - origin_) / resolution_;
  }
  /// The same world, seen from a frame that lies at p_frame: origin and start move.
  void seeFrom(const Eigen::Vector2d& p_frame);
  /// @param limit  m; obstacles farther away than this are not looked for.
  /// @return       m, distance from a point to the nearest obstacle cell, 0 inside one and beyond
  ///               the grid, at most limit. Cost: cells within the limit.
  double clearance(const Eigen::Vector2d& p_map, double limit) const;

  std::string name;                       ///< file name without extension
  std::optional<Pose2> start;             ///< from the YAML's `start: [x, y, yaw_deg]`
  std::vector<std::string> unknown_keys;  ///< of the YAML file, which nobody asked for

 private:
  int width_ = 0, height_ = 0;
  double resolution_ = 1.0;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<unsigned char> cells_;  // the grid's cells, one load a question
  mrpt::maps::COccupancyGridMap2D grid_;
};

/// Reads a map_server map: YAML (image, resolution, origin, occupied_thresh, free_thresh, negate,
/// mode: trinary or scale; plus an optional start) and the image beside it.
///
/// A cell is free where its occupancy, (255 - grey) / 255 or grey / 255 with negate, lies below
/// free_thresh; where that leaves no free cell the file is refused.
/// @throws std::runtime_error naming file, key and what is allowed.
World loadWorld(const std::string& yaml_path);

/// Where a robot starts when nobody says: the world's own start, else, of the largest region that
/// the robot can drive in, the cell farthest from all obstacles (the lowest, then leftmost of
/// equals), facing along x.
/// @throws std::runtime_error where no place has a clearance of `radius`.
Pose2 defaultStart(const World& world, double radius);

/// @throws std::runtime_error naming place and clearance where a robot of `radius` cannot stand.
void requireStandable(const World& world, const Pose2& T_map_robot, double radius);

}  // namespace cca
