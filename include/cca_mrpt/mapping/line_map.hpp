// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "cca_mrpt/mapping/line_segment.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/mapping/scan.hpp"

namespace cca {

/// One segment of the map, in the map frame.
struct MapLine {
  std::uint64_t id = 0;  ///< stable while the line exists
  LineSegment segment;
  double support = 0.0;  ///< number of laser returns that it stands on
};

/// Vertices of a chain of map lines that meet at their ends; closed where first equals last.
struct PolyLine {
  std::vector<Eigen::Vector2d> vertices;  ///< m, map frame
  std::vector<std::uint64_t> line_ids;    ///< the lines between neighbouring vertices
};

/// The incremental line map (the paper's steps 6-7).
class LineMap {
 public:
  explicit LineMap(const CcaParameters& parameters = {}) : parameters_(parameters) {}

  /// Takes a scan at its T_map_sensor. Cost does not depend on the size of the map.
  void insert(const Scan& scan);
  /// Merges scans that still wait for their batch to fill.
  void finishBatch();

  /// The lines as they stand, by rising id.
  std::vector<MapLine> lines() const;
  std::vector<PolyLine> polyLines() const;

 private:
  CcaParameters parameters_;
};

}  // namespace cca
