// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/geometry/arc.hpp"
#include "cca_mrpt/geometry/polygon.hpp"
#include "cca_mrpt/simulation/world.hpp"

namespace cca {

using WallFace = std::pair<Eigen::Vector2d, Eigen::Vector2d>;  ///< m, its two ends
using Opening = std::pair<double, double>;                     ///< m along a wall, from its start

/// m, thickness of the walls of generated buildings.
inline constexpr double kOuterWall = 0.2, kInnerWall = 0.1;

/// A building as vectors: solid polygons in a free rectangle from (0, 0) to (width, height). The
/// lines that a perfect mapper would find follow from it exactly.
struct Building {
  std::string name;
  double width = 0.0, height = 0.0;  ///< m
  Pose2 start;                       ///< where a robot stands when nobody says otherwise
  std::vector<Polygon> solids;       ///< may overlap
  std::vector<Arc> arcs;             ///< the round faces among them, of which solids have chords

  /// An axis-parallel box between two opposite corners.
  void addBox(const Eigen::Vector2d& lowest, const Eigen::Vector2d& highest);
  /// A box turned by `angle` rad about its centre.
  void addTurnedBox(const Eigen::Vector2d& centre, const Eigen::Vector2d& size, double angle);
  void addDisc(const Eigen::Vector2d& centre, double radius, int corners = 48);
  /// A straight wall along a centre line, with door openings.
  void addWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double thickness,
               const std::vector<Opening>& openings = {});
  /// A wall along an arc of `radius` (centre line) from one angle to a greater one, rad.
  void addArcWall(const Eigen::Vector2d& centre, double radius, double from_angle, double to_angle,
                  double thickness);
  /// Four walls along the rectangle's edges, inside it.
  void addOuterWalls(double thickness);
};

/// The plan's cells: solid where the cell's centre lies in a solid.
World rasterise(const Building& plan, double resolution);

/// The faces of the solids that border on free space which a point can get to from the start:
/// the parts of the polygons' edges with no other solid in front of them, collinear neighbours
/// joined. Ordered as the solids are. Cost: edges squared.
std::vector<WallFace> wallFaces(const Building& plan, double resolution);

}  // namespace cca
