// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cca_mrpt/geometry/arc.hpp"
#include "cca_mrpt/geometry/line_segment.hpp"

namespace cca {

/// What a line of the map is.
enum class LineKind : std::uint8_t {
  kWall,    ///< returns all along
  kDotted,  ///< posts, or a pane that few beams return from: rays pass between
};

/// As files name it.
inline const char* nameOf(LineKind kind) { return kind == LineKind::kDotted ? "dotted" : "wall"; }

/// One segment of the map, in the map frame.
struct MapLine {
  std::uint64_t id = 0;  ///< stable while the line exists
  /// From start to end the side it was seen from lies on the left; its covariance is that at its
  /// middle, see covarianceOf().
  LineSegment segment;
  double support = 0.0;  ///< number of laser returns that it stands on
  LineKind kind = LineKind::kWall;
  double share = 1.0;  ///< of its length that returns
};

/// Vertices of a chain of map lines that meet at their ends; closed where first equals last.
struct PolyLine {
  std::vector<Eigen::Vector2d> vertices;  ///< m, map frame
  std::vector<std::uint64_t> line_ids;    ///< the lines between neighbouring vertices
};

/// An arc of the map, map frame. It stands for lines that are there as well, its chords.
struct MapArc {
  Arc arc;                              ///< its support: bins of walls, not returns
  std::vector<std::uint64_t> line_ids;  ///< the chords, counter-clockwise or clockwise
};

}  // namespace cca
